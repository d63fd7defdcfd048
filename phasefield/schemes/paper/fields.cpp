#include "phasefield/schemes/paper/fields.h"

#include <cmath>

namespace endoflow::phasefield::paper {

std::vector<unsigned int> flow_degrees(const PhaseFieldParameters& p) {
    const auto k = static_cast<unsigned int>(p.degree), ku = static_cast<unsigned int>(p.velocity_degree),
               kt = static_cast<unsigned int>(p.tension_degree);
    return {ku, ku, ku - 1, kt, k, k, k};
}

void close_flow_constraints(Space& space, const Parameters& p) {
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        const bool outer = boundary != axis;
        const bool pinned =
            boundary == side && std::abs(z - p.domain.membrane_height) <= p.domain.pin_half_width * (1 + 1e-12);
        const bool fixed = (component == u_r && boundary == axis) || (component == u_z && pinned) ||
                           (component == tension && outer) || (component == phi && boundary == side);
        if (fixed && !space.constraints.is_constrained(index)) space.constraints.add_line(index);
    });
    if (p.fluid.dynamics == Dynamics::geometric)
        switch_off(space, {u_r, u_z, pressure, tension});
    else if (!p.membrane.inextensible)
        switch_off(space, {tension});
    space.constraints.close();
}

}  // namespace endoflow::phasefield::paper
