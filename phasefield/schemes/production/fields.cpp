#include "phasefield/schemes/production/fields.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace endoflow::phasefield::production {

std::vector<unsigned int> field_degrees(const PhaseFieldParameters& p) {
    const auto k = static_cast<unsigned int>(p.degree), ku = static_cast<unsigned int>(p.velocity_degree),
               kt = static_cast<unsigned int>(p.tension_degree), ks = static_cast<unsigned int>(p.surface_degree);
    return {ku, ku, ku - 1, kt, kt, k, k, k, ks, ks, ks};
}

ContourFields contour_fields(const Space& space, const Vector& solution) {
    return {&space, &solution, distance, velocity_r, velocity_z, tension, 1, &space, &solution, molecule_density};
}

namespace {

/// The value that an unknown at height z on a boundary is held at, if it is.
std::optional<double> boundary_value(dealii::types::boundary_id boundary, unsigned int component, double z,
                                     const Parameters& p) {
    const double above = z - p.domain.membrane_height, height = std::abs(above) * (1 - 1e-12);
    const double layer = std::max(p.domain.pin_half_width, p.phase_field.band_width * p.phase_field.epsilon);
    if (component == velocity_r && boundary == axis) return 0;
    if (boundary != side) return {};
    if (component == membrane_stretch) return 1;
    if (component == velocity_z && height <= p.domain.pin_half_width) return 0;
    if (component == normal_force && height <= layer) return 0;
    if (component == distance && height <= layer) return -above;
    return {};
}

}  // namespace

void close_constraints(Space& space, const Parameters& p) {
    const bool flow = p.fluid.dynamics == Dynamics::flow;
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        if (boundary_value(boundary, component, z, p) && !space.constraints.is_constrained(index))
            space.constraints.add_line(index);
    });
    if (!flow) switch_off(space, {velocity_r, velocity_z, pressure, pressure_layer, tension, membrane_stretch});
    if (flow && !p.membrane.inextensible) switch_off(space, {tension});
    space.constraints.close();
}

void impose_boundary_values(const Space& space, const Parameters& p, Vector& vector) {
    vector.zero_out_ghost_values();
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        const auto value = boundary_value(boundary, component, z, p);
        if (value && space.owned.is_element(index)) vector(index) = *value;
    });
    finish_interpolation(space, vector);
}

}  // namespace endoflow::phasefield::production
