#include "shared/model/transport_law.h"

#include "shared/model/double_well.h"
#include "shared/model/membrane_energy.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

ValueAndDerivatives concentration_itself(double c, double /*width*/) {
    return {c, 1, 0};
}

/// W'(c)/ε_c
ValueAndDerivatives separating(double c, double width) {
    const ValueAndDerivatives well = double_well(c);
    return {well.first / width, well.second / width, double_well_third(c) / width};
}

}  // namespace

TransportLaw transport_law(const MoleculeParameters& molecules) {
    switch (molecules.transport) {
        case Transport::cahn_hilliard:  // (23), (24)
            return {molecules.mobility, molecules.interface_width, separating, energetically_coupled(molecules)};
        case Transport::fickian:  // (22)
            return {molecules.diffusivity, 0, concentration_itself, false};
        case Transport::advection:  // (14)
            return {0, 0, concentration_itself, false};
    }
    throw InputError("molecules.transport: not a law");
}

}  // namespace endoflow
