#include "statics/point_equations.h"

#include "shared/model/initial_condition.h"

namespace endoflow::statics {

Material material_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    return {stationary.energy,
            p.molecules,
            loads_of(p),
            molecules_are_frozen(p),
            initial_coat_within(p.molecules, p.domain.radius),
            {}};
}

Setting setting_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    const bool frozen = molecules_are_frozen(p);
    return {material_of(stationary),
            transport_law(p.molecules),
            p.domain.radius,
            p.domain.membrane_height,
            frozen ? state::frozen_states : state::equilibrium_states,
            frozen ? 1 : 2};
}

Setting setting_of(const ClosedMembrane& membrane) {
    return {{{}, {}, {}, true, 0, membrane}, {}, 0, 0, state::closed_states, 1};
}

}  // namespace endoflow::statics
