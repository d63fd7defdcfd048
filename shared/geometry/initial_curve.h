#pragma once

#include <vector>

#include "shared/geometry/spheroid.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// The initial spheroid of a case in free space, around z = domain.membrane_height.
[[nodiscard]] Spheroid initial_spheroid(const DomainParameters& domain);

/// Throws InputError where the case is an inextensible sphere in a fluid: it keeps its shape, and λ is not determined.
void require_deformable(const Parameters& parameters);

/// Where a run starts: a flat membrane across the box, or a spheroid in free space, by a parameter s in [0, 1] from the
/// axis to the rim or from the upper pole to the lower.
class InitialCurve {
  public:
    explicit InitialCurve(const Parameters& parameters);

    [[nodiscard]] double radius(double s) const;
    [[nodiscard]] double height(double s) const;
    /// By the distance from the axis along the membrane.
    [[nodiscard]] double concentration(double s) const;

  private:
    Parameters parameters_;
    Spheroid spheroid_;
    std::vector<double> arc_length_;  // of the spheroid at equal steps of s, nm

    [[nodiscard]] bool closed() const { return parameters_.domain.kind == DomainKind::free_space; }
    [[nodiscard]] double distance(double s) const;
};

}  // namespace endoflow
