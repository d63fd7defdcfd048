#pragma once

#include "shared/geometry/initial_curve.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield {

/// What a point of the half plane sees of the membrane at rest.
struct InitialPoint {
    double distance;   // from the membrane, positive in the extracellular fluid [nm]
    double curvature;  // κ at the closest point [1/nm]
    double molecules;  // c there
};

/// The membrane at the start as the layer sees it: the signed distance, and what is constant along the normals.
class InitialMembrane {
  public:
    explicit InitialMembrane(const Parameters& parameters);

    [[nodiscard]] InitialPoint at(double r, double z) const;
    /// Positions and c at points no farther apart than `spacing` [nm].
    [[nodiscard]] MembraneCurve curve(double spacing) const;

  private:
    DomainParameters domain_;
    Spheroid spheroid_;
    InitialCurve curve_;
};

}  // namespace endoflow::phasefield
