#include "shared/model/exchange.h"

#include "shared/support/error.h"

namespace endoflow {

ExchangeLaw::ExchangeLaw(const MoleculeParameters& molecules)
    : kind_(molecules.exchange),
      on_rate_(molecules.on_rate),
      off_rate_(molecules.off_rate),
      edge_rate_(std::numbers::sqrt2 * molecules.edge_speed / molecules.interface_width),
      sensing_(molecules.curvature_sensing * molecules.molecule_area / molecules.thermal_energy),
      per_pool_(molecules.pool_area > 0 ? 1 / molecules.pool_area : 0) {}

void require_no_exchange(const Parameters& parameters, const std::string& engine) {
    if (parameters.molecules.exchange == Exchange::none) return;
    throw InputError("molecules.exchange must be none: the " + engine + " engine does not have another one");
}

}  // namespace endoflow
