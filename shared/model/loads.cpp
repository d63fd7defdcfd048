#include "shared/model/loads.h"

#include "shared/model/exchange.h"
#include "shared/model/maturation.h"
#include "shared/support/error.h"

namespace endoflow {

void require_no_loads(const Parameters& parameters, const std::string& engine) {
    if (!loads_of(parameters).none())
        throw InputError("membrane.rim_tension, membrane.pole_force and fluid.pressure_difference must be 0: the " +
                         engine + " engine does not have them");
    if (parameters.molecules.coupling != Coupling::none)
        throw InputError("molecules.coupling must be none: the " + engine + " engine does not have another one");
    require_no_exchange(parameters, engine);
    require_no_maturation(parameters, engine + " engine");
}

}  // namespace endoflow
