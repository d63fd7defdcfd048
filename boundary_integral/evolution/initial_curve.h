#pragma once

// Where a run starts: a flat membrane across the box, or a spheroid in free space, by a parameter s in [0, 1] from the
// axis to the rim or from the upper pole to the lower.

#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

class InitialCurve {
  public:
    explicit InitialCurve(const Parameters& parameters);

    double radius(double s) const;
    double height(double s) const;
    double concentration(double s) const;  // by the distance from the axis along the membrane

  private:
    const Parameters& parameters_;
    std::vector<double> arc_length_;  // of the spheroid at equal steps of s, nm

    bool closed() const { return parameters_.domain.kind == DomainKind::free_space; }
    double speed(double s) const;
    double distance(double s) const;
};

}  // namespace endoflow::boundary_integral
