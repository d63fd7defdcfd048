#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shared/geometry/membrane_curve.h"
#include "shared/model/loads.h"
#include "shared/output/checkpoint.h"

namespace endoflow::phasefield::production {

/// The pole force per area as data of a step, as the layer's thickness is: it rides on the material, whose label is the
/// area from the pole along the membrane as it is predicted for the end of the step.
class PoleForce {
  public:
    PoleForce(const MembraneCurve& membrane, const Loads& loads);

    /// At the membrane's point closest to (r, z), along e_z [pN/nm²].
    [[nodiscard]] double at(double r, double z) const;

    void save(const std::string& name, Checkpoint& checkpoint) const;
    /// What was saved; nothing where nothing was.
    static std::shared_ptr<const PoleForce> load(const Checkpoint& checkpoint, const std::string& name,
                                                 const Loads& loads);

  private:
    explicit PoleForce(const Loads& loads) : loads_(loads) {}

    Loads loads_;
    std::vector<double> r_, z_, area_;  // [nm, nm²]
};

}  // namespace endoflow::phasefield::production
