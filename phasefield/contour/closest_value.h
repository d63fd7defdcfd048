#pragma once

#include <vector>

#include "shared/geometry/axisymmetric_spline.h"

namespace endoflow::phasefield {

/// A quantity given at the points of a curve that starts on the axis [nm], and at the closest point of the curve
/// anywhere. Curve and quantity are cubic splines of the chord length: the polyline's closest point sticks to its
/// corners, which are others in every step.
class ClosestValue {
  public:
    ClosestValue(std::vector<double> r, std::vector<double> z, const std::vector<double>& values);

    [[nodiscard]] double at(double r, double z) const;

  private:
    std::vector<double> r_, z_, t_;
    FarEnd end_;
    AxisymmetricSpline spline_r_, spline_z_, values_;
};

}  // namespace endoflow::phasefield
