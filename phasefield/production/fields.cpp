#include "phasefield/production/fields.h"

#include <cmath>

namespace endoflow::phasefield::production {

std::vector<unsigned int> field_degrees(const PhaseFieldParameters& p) {
    const auto k = static_cast<unsigned int>(p.degree), ku = static_cast<unsigned int>(p.velocity_degree),
               kt = static_cast<unsigned int>(p.tension_degree), ks = static_cast<unsigned int>(p.surface_degree);
    return {ku, ku, ku - 1, kt, kt, k, k, k, ks, ks, ks};
}

void close_constraints(Space& space, const Parameters& p) {
    const bool flow = p.fluid.dynamics == Dynamics::flow;
    const auto height_of_pin = p.domain.pin_half_width * (1 + 1e-12);
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        const bool pinned = boundary == side && std::abs(z - p.domain.membrane_height) <= height_of_pin;
        const bool fixed =
            (component == velocity_r && boundary == axis) ||
            (pinned && (component == velocity_z || component == distance || component == normal_force)) ||
            (boundary == side && component == membrane_stretch);
        if (fixed && !space.constraints.is_constrained(index)) space.constraints.add_line(index);
    });
    if (!flow) switch_off(space, {velocity_r, velocity_z, pressure, pressure_layer, tension, membrane_stretch});
    if (flow && !p.membrane.inextensible) switch_off(space, {tension});
    space.constraints.close();
}

}  // namespace endoflow::phasefield::production
