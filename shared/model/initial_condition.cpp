#include "shared/model/initial_condition.h"

#include <cmath>
#include <numbers>

namespace endoflow {

double initial_concentration(const MoleculeParameters& molecules, double r) {
    const double distance = r - molecules.patch_radius;
    return 0.5 * (1 - std::tanh(distance / (std::numbers::sqrt2 * molecules.interface_width)));
}

}  // namespace endoflow
