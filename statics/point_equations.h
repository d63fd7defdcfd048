#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "shared/model/initial_condition.h"
#include "shared/model/loads.h"
#include "shared/model/transport_law.h"
#include "statics/shape_equations.h"

namespace endoflow::statics {

// The stationary membrane at one point, in any number type: what shapes from the axis to an end and shapes with a held
// neck share. docs/statics.md derives it.

/// What the membrane is at each of its points.
struct Material {
    MembraneEnergy energy;
    MoleculeParameters molecules;
    Loads loads;
    bool frozen;                           // the molecules
    double coat;                           // ∫ c da of the initial membrane, nm²
    std::optional<ClosedMembrane> closed;  // instead of all of the above
};

/// What a case says to the equations.
struct Setting {
    Material material;
    TransportLaw transport;
    double rim_radius, rim_height;
    Eigen::Index states;   // of a point
    Eigen::Index globals;  // of a shape from the axis to its end
};

[[nodiscard]] Material material_of(const StationaryCase& stationary);
[[nodiscard]] Setting setting_of(const StationaryCase& stationary);
[[nodiscard]] Setting setting_of(const ClosedMembrane& membrane);

/// c and dc/da at one point.
template <class Number>
struct Concentration {
    Number value, slope;
};

/// Those of the material with label a: c is the tanh profile in the radius ρ = √(2a) it had, dc/dρ = −√2 c (1 − c)/ε_c.
template <class Number>
[[nodiscard]] Concentration<Number> frozen_concentration(const MoleculeParameters& molecules, const Number& a) {
    const double c = initial_concentration_of_material(molecules, value_of(a));
    const double rho = std::sqrt(2 * std::max(value_of(a), 0.0)), epsilon = molecules.interface_width;
    if (rho == 0) return {chain(a, c, 0), 0.0};
    const double steepness = std::numbers::sqrt2 / epsilon, by_rho = -steepness * c * (1 - c);
    const double slope = by_rho / rho;
    return {chain(a, c, slope), chain(a, slope, (-steepness * (1 - 2 * c) * slope - slope / rho) / rho)};
}

/// What the equations need at one point besides the states.
template <class Number>
struct MaterialPoint {
    Concentration<Number> c;
    ElasticState<Number> elastic;
    Number pressure;       // p, pN/nm²
    Number stress;         // 2 (∂e/∂|∇c|²) (dc/da)², the tension of c's gradient over r², pN/nm³
    Number force, spread;  // Z and Z/r²: minus what pulls along z between the pole and a, over 2π, pN and pN/nm²
    Number squeeze;        // −f_r/r, f_r what rides on the material along r, pN/nm³
};

/// ∫ c da between the pole and a over that of the whole membrane.
template <class Number, class States>
[[nodiscard]] Number coat_within(const Material& material, const States& y, const Number& a,
                                 const Concentration<Number>& c) {
    if (!material.frozen) return y[state::mass] / material.coat;
    const double within =
        initial_coat_within(material.molecules, std::sqrt(2 * std::max(value_of(a), 0.0))) / material.coat;
    return chain(a, within, value_of(c.value) / material.coat);
}

/// `y` holds the states at x = a/E, `a` is the label.
template <class Number, class States>
[[nodiscard]] MaterialPoint<Number> material_point(const Material& material, const States& y, double x, const Number& a,
                                                   const Number& pressure) {
    MaterialPoint<Number> point{};
    point.pressure = pressure;
    if (material.closed) {
        point.c = {material.closed->concentration(), 0.0};
        point.elastic = material.closed->elastic(x, Number(y[state::moment]));
        return point;
    }
    const bool on_axis = value_of(a) == 0;
    if (material.frozen)
        point.c = frozen_concentration(material.molecules, a);
    else
        point.c = {y[state::concentration], on_axis ? Number(0.0) : y[state::gradient] / y[state::r_squared]};
    const Number squared_slope = point.c.slope * point.c.slope;
    point.elastic = elastic_state(material.energy, Number(y[state::moment]), point.c.value,
                                  Number(y[state::r_squared] * squared_slope));
    point.stress = 2.0 * point.elastic.by_squared_gradient * squared_slope;
    if (material.loads.vertical()) {
        Number pull = material.loads.material_force_within(Number(2 * std::numbers::pi * a));
        if (material.loads.coat_force != 0)
            pull = pull + material.loads.coat_force * coat_within(material, y, a, point.c);
        point.force = (-0.5 / std::numbers::pi) * pull;
    }
    if (material.loads.radial() && !on_axis) {
        const double r2 = value_of(y[state::r_squared]), by_r = 1 / std::sqrt(r2);
        point.squeeze = -1.0 * material.loads.radial_force(Number(2 * std::numbers::pi * a)) *
                        chain(Number(y[state::r_squared]), by_r, -0.5 * by_r / r2);
    }
    point.spread = on_axis ? Number(0.0) : point.force / y[state::r_squared];
    return point;
}

/// λ = m κ1 + Q cos θ + (½ p r² − Z) κ2 + 2 (∂e/∂|∇c|²) |∇c|² − e: the first integral, from the balance along the
/// membrane.
template <class Number, class States>
[[nodiscard]] Number tension(const MaterialPoint<Number>& point, const States& y) {
    const Number &hoop = y[state::hoop], &r2 = y[state::r_squared];
    return y[state::moment] * (point.elastic.curvature - hoop) + y[state::thrust] * y[state::cosine] +
           (0.5 * point.pressure * r2 - point.force) * hoop + r2 * point.stress - point.elastic.density;
}

/// κ1 − κ2, zero where the meridian is smooth on the axis.
template <class Number, class States>
[[nodiscard]] Number kink(const MaterialPoint<Number>& point, const States& y) {
    return point.elastic.curvature - 2.0 * y[state::hoop];
}

/// Zero on the axis above a bud: three conditions, and two of molecules in equilibrium.
template <class Number, class States>
[[nodiscard]] std::vector<Number> axis_conditions(const Setting& setting, const MaterialPoint<Number>& point,
                                                  const States& y) {
    std::vector<Number> zero{y[state::r_squared], y[state::cosine] - 1.0, kink(point, y)};
    if (!setting.material.frozen) zero.insert(zero.end(), {y[state::gradient], y[state::mass]});
    return zero;
}

/// Zero at the rim of the box: four conditions, a horizontal tangent among them, and two of molecules in equilibrium,
/// none of which passes.
template <class Number, class States>
[[nodiscard]] std::vector<Number> rim_conditions(const Setting& setting, const MaterialPoint<Number>& point,
                                                 const States& y) {
    std::vector<Number> zero{y[state::r_squared] - setting.rim_radius * setting.rim_radius, y[state::hoop],
                             tension(point, y) - setting.material.loads.rim_tension,
                             y[state::height] - setting.rim_height};
    if (!setting.material.frozen) zero.insert(zero.end(), {y[state::gradient], y[state::mass] - setting.material.coat});
    return zero;
}

/// Δ_Γ c as a function of c and μ: zero of the chemical potential's deviation from its constant. Under energetic
/// coupling that is ∂e/∂c − 2 ∇_Γ·((∂e/∂|∇c|²) ∇_Γ c) over σ̂, with ∂e/∂|∇c|² = ½ σ̂ ε_c everywhere.
template <class Number>
[[nodiscard]] Number concentration_source(const Setting& setting, const MaterialPoint<Number>& point,
                                          const Number& potential) {
    const Number& c = point.c.value;
    if (setting.transport.energetic) {
        const double line_energy = setting.material.molecules.line_energy;
        return (point.elastic.by_concentration / line_energy - potential) / setting.material.molecules.interface_width;
    }
    const ValueAndDerivatives local = setting.transport.potential(c.value);
    const Number deviation = chain(c, local.value, local.first) - potential;
    if (setting.transport.edge_width == 0) {
        const double length = 0.25 * setting.rim_radius;  // any length will do: p(c) = μ everywhere
        return deviation / (length * length);
    }
    return deviation / setting.transport.edge_width;
}

/// dy/da of the states at one point.
template <class Number, class States>
[[nodiscard]] std::array<Number, state::equilibrium_states> slopes_by_label(const Setting& setting,
                                                                            const MaterialPoint<Number>& point,
                                                                            const States& states,
                                                                            const Number& potential) {
    const Number &y = states[state::r_squared], &w = states[state::cosine], &hoop = states[state::hoop],
                 &m = states[state::moment], &thrust = states[state::thrust];
    const Number& curvature = point.elastic.curvature;
    const Number anisotropy = (curvature - 2.0 * hoop) / y;  // (κ1 − κ2)/r²
    const Number half_pressure = 0.5 * point.pressure;

    std::array<Number, state::equilibrium_states> by_a;
    by_a[state::r_squared] = 2.0 * w;
    by_a[state::cosine] = -hoop * (curvature - hoop);
    by_a[state::hoop] = w * anisotropy;
    by_a[state::moment] = thrust * hoop + (point.spread - half_pressure) * w;  // normal force balance, (A.25)
    by_a[state::thrust] =
        m * anisotropy + point.stress - (point.spread + half_pressure) * hoop + point.squeeze;  // radial force balance
    by_a[state::height] = -hoop;
    if (setting.material.closed) {
        by_a[state::volume] = y * hoop;
        by_a[state::energy] = point.elastic.density;
    } else if (!setting.material.frozen) {
        by_a[state::concentration] = point.c.slope;
        by_a[state::gradient] = concentration_source(setting, point, potential);
        by_a[state::mass] = point.c.value;
    }
    return by_a;
}

}  // namespace endoflow::statics
