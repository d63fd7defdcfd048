#include "shared/model/time_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/model/bending_model.h"
#include "shared/model/loads.h"
#include "shared/model/membrane_energy.h"

namespace endoflow {

namespace {

/// Parts of structure_time: 10⁻⁵ and 0.2 µs in the standard case.
constexpr double first_part = 1.9458e-4, longest_part = 3.8916;
/// Of exchange_time.
constexpr double longest_part_of_exchange = 0.02;
constexpr double least_early_part = 0.1;

}  // namespace

double largest_stiffness(const MembraneParameters& membrane) {
    const BendingModel model(membrane);
    return std::max(model.stiffness(0).value, model.stiffness(1).value);
}

double length_of_structure(const Parameters& p) {
    double length = p.domain.kind == DomainKind::box
                        ? p.domain.radius
                        : std::min(p.domain.spheroid_polar_axis, p.domain.spheroid_equatorial_axis);
    const auto no_longer_than = [&](double numerator, double denominator, double power) {
        if (denominator != 0) length = std::min(length, std::pow(numerator / std::abs(denominator), power));
    };
    const double stiffness = largest_stiffness(p.membrane);
    const Loads loads = loads_of(p);
    no_longer_than(2, BendingModel(p.membrane).spontaneous_curvature(1).value, 1);
    no_longer_than(stiffness / 2, loads.rim_tension, 1.0 / 2);
    no_longer_than(2 * std::numbers::pi * stiffness, loads.pole_force, 1);
    no_longer_than(2 * std::numbers::pi * stiffness, loads.coat_force, 1);
    no_longer_than(2 * std::numbers::pi * stiffness, loads.collar_force, 1);
    no_longer_than(stiffness, loads.pressure, 1.0 / 3);
    if (energetically_coupled(p.molecules)) length = std::min(length, p.molecules.patch_radius / 2);
    return length;
}

double relaxation_time(const Parameters& p, double length) {
    const double stiffness = largest_stiffness(p.membrane);
    if (p.fluid.dynamics == Dynamics::geometric)
        return std::pow(length * p.molecules.interface_width, 2) / (p.fluid.normal_mobility * stiffness);
    return (p.fluid.viscosity_extracellular + p.fluid.viscosity_intracellular) * std::pow(length, 3) / stiffness;
}

double structure_time(const Parameters& p) {
    return relaxation_time(p, length_of_structure(p));
}

double exchange_time(const Parameters& p) {
    switch (p.molecules.exchange) {
        case Exchange::none:
            return 0;
        case Exchange::reservoir:
            return 1 / (p.molecules.on_rate + p.molecules.off_rate);
        case Exchange::edge:
            return length_of_structure(p) / p.molecules.edge_speed;
    }
    return 0;
}

double first_step(const Parameters& p) {
    return p.time.initial_step > 0 ? p.time.initial_step : first_part * structure_time(p);
}

double longest_step(const Parameters& p) {
    if (p.time.max_step > 0) return p.time.max_step;
    return std::max(longest_part * structure_time(p), longest_part_of_exchange * exchange_time(p));
}

double early_part(double time, const Parameters& p) {
    return std::clamp(std::cbrt(time / structure_time(p)), least_early_part, 1.0);
}

double time_tolerance(const Parameters& p, double chosen) {
    return p.time.tolerance > 0 ? p.time.tolerance : chosen;
}

}  // namespace endoflow
