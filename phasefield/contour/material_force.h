#pragma once

#include <vector>

#include "shared/geometry/membrane_curve.h"
#include "shared/model/loads.h"

namespace endoflow::phasefield {

/// Area between the pole and each point of a membrane [nm²]: the material's label.
[[nodiscard]] std::vector<double> area_from_pole(const MembraneCurve& membrane);

/// Per area of membrane, pN/nm².
struct ForceDensity {
    double r = 0, z = 0;
};

/// What rides on the material per area, the pole force, the ring's and the collar's, as data of a step, as the layer's
/// thickness is: the material's label is the area from the pole along the membrane as it is predicted for the end of
/// the step.
class MaterialForce {
  public:
    MaterialForce(const MembraneCurve& membrane, const Loads& loads);

    /// At the membrane's point closest to (r, z).
    [[nodiscard]] ForceDensity at(double r, double z) const;

  private:
    Loads loads_;
    std::vector<double> r_, z_, area_;  // [nm, nm²]
};

}  // namespace endoflow::phasefield
