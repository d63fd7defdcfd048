#pragma once

#include <gsl/gsl_spline.h>

#include <memory>
#include <vector>

#include "shared/geometry/meridian.h"

namespace endoflow {

/// What a curve ends at, having started on the axis.
enum class FarEnd { free, axis };

/// The parameter that all splines of a curve share: chord length from its first point [nm].
[[nodiscard]] std::vector<double> chord_length(const std::vector<double>& r, const std::vector<double>& z);

/// Cubic spline of a function known at parameters 0 = t0 < t1 < …, continued to t < 0 as an even or odd function, and
/// so beyond the last parameter of a curve that ends on the axis.
class AxisymmetricSpline {
  public:
    AxisymmetricSpline(const std::vector<double>& t, const std::vector<double>& values, Parity parity,
                       FarEnd end = FarEnd::free);

    [[nodiscard]] double value(double t) const { return gsl_spline_eval(spline_.get(), t, nullptr); }
    [[nodiscard]] double derivative(double t) const { return gsl_spline_eval_deriv(spline_.get(), t, nullptr); }
    [[nodiscard]] double second_derivative(double t) const { return gsl_spline_eval_deriv2(spline_.get(), t, nullptr); }

  private:
    std::unique_ptr<gsl_spline, decltype(&gsl_spline_free)> spline_;
};

}  // namespace endoflow
