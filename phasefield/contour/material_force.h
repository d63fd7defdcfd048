#pragma once

#include <vector>

#include "shared/geometry/membrane_curve.h"
#include "shared/model/loads.h"

namespace endoflow::phasefield {

/// What rides on the material per area, the pole force and the ring's, as data of a step, as the layer's thickness is:
/// the material's label is the area from the pole along the membrane as it is predicted for the end of the step.
class MaterialForce {
  public:
    MaterialForce(const MembraneCurve& membrane, const Loads& loads);

    /// At the membrane's point closest to (r, z), along e_z [pN/nm²].
    [[nodiscard]] double at(double r, double z) const;

  private:
    Loads loads_;
    std::vector<double> r_, z_, area_;  // [nm, nm²]
};

}  // namespace endoflow::phasefield
