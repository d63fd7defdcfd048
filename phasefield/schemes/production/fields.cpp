#include "phasefield/schemes/production/fields.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "phasefield/layer/constants.h"
#include "shared/model/time_scale.h"

namespace endoflow::phasefield::production {

namespace {

using Held = std::optional<double>;
using BoundaryId = dealii::types::boundary_id;
using Numerics = PhaseFieldParameters;

constexpr double rim_half_width = constant("rim_half_width");

unsigned int degree_of(int degree) {
    return static_cast<unsigned int>(degree);
}

/// Where the pin band, or the whole layer, meets the side wall.
bool at_rim(BoundaryId boundary, double above, double half_width) {
    return boundary == side && std::abs(above) * (1 - 1e-12) <= half_width;
}
double layer_half_width(const Parameters& p) {
    return std::max(p.domain.pin_half_width, rim_half_width * p.phase_field.epsilon);
}

bool without_flow(const Parameters& p) {
    return p.fluid.dynamics != Dynamics::flow;
}
bool without_tension(const Parameters& p) {
    return without_flow(p) || !p.membrane.inextensible;
}

bool in_free_space(const Parameters& p) {
    return p.domain.kind == DomainKind::free_space;
}

// Around a vesicle the side rests, so that it cannot drift away, and fluid crosses top and bottom.
Held no_radial_velocity(BoundaryId boundary, double /*above*/, const Parameters& p) {
    return boundary == axis || (boundary == side && in_free_space(p)) ? Held(0) : std::nullopt;
}
Held pinned(BoundaryId boundary, double above, const Parameters& p) {
    const bool held = in_free_space(p) ? boundary == side : at_rim(boundary, above, p.domain.pin_half_width);
    return held ? Held(0) : std::nullopt;
}
bool at_layers_rim(BoundaryId boundary, double above, const Parameters& p) {
    return !in_free_space(p) && at_rim(boundary, above, layer_half_width(p));
}
Held flat_at_rim(BoundaryId boundary, double above, const Parameters& p) {
    return at_layers_rim(boundary, above, p) ? Held(-above) : std::nullopt;
}
Held no_force_at_rim(BoundaryId boundary, double above, const Parameters& p) {
    return at_layers_rim(boundary, above, p) ? Held(0) : std::nullopt;
}
Held unstretched_at_side(BoundaryId boundary, double /*above*/, const Parameters& p) {
    return boundary == side && !in_free_space(p) ? Held(1) : std::nullopt;
}

double initial_distance(const InitialPoint& at, const MembraneEnergy& /*energy*/) {
    return at.distance;
}
double initial_moment(const InitialPoint& at, const MembraneEnergy& energy) {
    return -energy.density(at.curvature, at.molecules, 0).partial[local::curvature];
}
double initial_molecules(const InitialPoint& at, const MembraneEnergy& /*energy*/) {
    return at.molecules;
}
double one(const InitialPoint& /*at*/, const MembraneEnergy& /*energy*/) {
    return 1;
}

double speed_size(const Scales& by) {
    return by.speed;
}
double tension_size(const Scales& by) {
    return by.stiffness / (by.length * by.length);
}
double pressure_size(const Scales& by) {
    return tension_size(by) / by.length;
}
double length_size(const Scales& by) {
    return by.length;
}
double force_size(const Scales& by) {
    return by.stiffness / (by.length * by.thickness * by.thickness);  // of what bends over ε
}
double moment_size(const Scales& by) {
    return by.stiffness / by.length;
}
double unit_size(const Scales& /*by*/) {
    return 1;
}
double potential_size(const Scales& by) {
    return 1 / by.thickness;
}

unsigned int of_velocity(const Numerics& p) {
    return degree_of(p.velocity_degree);
}
unsigned int of_pressure(const Numerics& p) {
    return degree_of(p.velocity_degree) - 1;
}
unsigned int of_tension(const Numerics& p) {
    return degree_of(p.tension_degree);
}
unsigned int of_shape(const Numerics& p) {
    return degree_of(p.degree);
}
unsigned int of_surface(const Numerics& p) {
    return degree_of(p.surface_degree);
}

}  // namespace

const std::array<Unknown, n_fields>& unknowns() {
    // λ = 0 at the rim is natural.
    static const std::array<Unknown, n_fields> table{{
        {velocity_r, "velocity", of_velocity, speed_size, no_radial_velocity, nullptr, without_flow},
        {velocity_z, "velocity", of_velocity, speed_size, pinned, nullptr, without_flow},
        {pressure, "pressure_outside_layer", of_pressure, pressure_size, nullptr, nullptr, without_flow},
        {pressure_layer, "layer_pressure", of_tension, tension_size, nullptr, nullptr, without_flow},
        {tension, "lambda", of_tension, tension_size, nullptr, nullptr, without_tension},
        {distance, "distance", of_shape, length_size, flat_at_rim, initial_distance, nullptr},
        {normal_force, "normal_force", of_shape, force_size, no_force_at_rim, nullptr, nullptr},
        {moment, "moment", of_shape, moment_size, nullptr, initial_moment, nullptr},
        {molecule_density, "c", of_surface, unit_size, nullptr, initial_molecules, nullptr},
        {molecule_potential, "chemical_potential", of_surface, potential_size, nullptr, nullptr, nullptr},
        {membrane_stretch, "stretching", of_surface, unit_size, unstretched_at_side, one, without_flow},
    }};
    return table;
}

bool carried_along(unsigned int field, const Parameters& p) {
    return (field == molecule_density || field == molecule_potential) && !energetically_coupled(p.molecules);
}

std::vector<unsigned int> field_degrees(const PhaseFieldParameters& p) {
    std::vector<unsigned int> degrees;
    for (const auto& unknown : unknowns()) degrees.push_back(unknown.degree(p));
    return degrees;
}

Scales scales(const Parameters& p) {
    const double length = length_of_structure(p);
    return {length, p.phase_field.epsilon, length / structure_time(p), largest_stiffness(p.membrane)};
}

Vector initial_fields(const Space& space, const Parameters& p, const MembraneEnergy& energy) {
    Vector out = space.vector();
    const InitialMembrane membrane(p);
    for (const auto& unknown : unknowns())
        if (unknown.initial != nullptr)
            interpolate(
                space, unknown.field, [&](double r, double z) { return unknown.initial(membrane.at(r, z), energy); },
                out);
    finish_interpolation(space, out);
    return out;
}

ContourFields contour_fields(const Space& space, const Vector& solution) {
    return {&space, &solution, distance, velocity_r, velocity_z, tension, 1, &space, &solution, molecule_density};
}

namespace {

/// The value that an unknown at height z on a boundary is held at, if it is.
Held boundary_value(BoundaryId boundary, unsigned int component, double z, const Parameters& p) {
    const auto held = unknowns()[component].held;
    return held == nullptr ? std::nullopt : held(boundary, z - p.domain.membrane_height, p);
}

}  // namespace

void close_constraints(Space& space, const Parameters& p) {
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        if (boundary_value(boundary, component, z, p) && !space.constraints.is_constrained(index))
            space.constraints.add_line(index);
    });
    std::vector<unsigned int> off;
    for (const auto& unknown : unknowns())
        if (unknown.switched_off != nullptr && unknown.switched_off(p)) off.push_back(unknown.field);
    switch_off(space, off);
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
