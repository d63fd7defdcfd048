#include "shared/model/loads.h"

#include "shared/model/exchange.h"
#include "shared/model/maturation.h"
#include "shared/support/error.h"

namespace endoflow {

Loads loads_of(const Parameters& parameters) {
    const MembraneParameters& membrane = parameters.membrane;
    const auto area = [](double radius) { return std::numbers::pi * radius * radius; };
    return {membrane.rim_tension,          parameters.fluid.pressure_difference,
            membrane.pole_force,           membrane.pole_force_width,
            membrane.coat_force,           {area(membrane.coat_force_ring[0]), area(membrane.coat_force_ring[1])},
            membrane.collar_force,         membrane.collar_width,
            area(membrane.collar_position)};
}

void require_no_loads(const Parameters& parameters, const std::string& engine) {
    if (!loads_of(parameters).none())
        throw InputError(
            "membrane.rim_tension, membrane.pole_force, membrane.coat_force, membrane.collar_force and "
            "fluid.pressure_difference must be 0: the " +
            engine + " engine does not have them");
    if (parameters.molecules.coupling != Coupling::none)
        throw InputError("molecules.coupling must be none: the " + engine + " engine does not have another one");
    require_no_exchange(parameters, engine);
    require_no_maturation(parameters, engine + " engine");
}

}  // namespace endoflow
