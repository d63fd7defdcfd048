#include "statics/shape_equations.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "shared/model/initial_condition.h"
#include "shared/model/loads.h"
#include "shared/model/transport_law.h"
#include "statics/dual_system.h"

namespace endoflow::statics {

namespace {

constexpr std::size_t unknowns = static_cast<std::size_t>(state::equilibrium_states) + 2;  // states and globals
using Number = Dual<unknowns>;
using std::numbers::pi;

/// What a case says to the equations.
struct Setting {
    MembraneEnergy energy;
    TransportLaw transport;
    Loads loads;
    MoleculeParameters molecules;
    double rim_radius, rim_height;
    double mass;  // ∫ c da of the initial membrane, nm²
    bool frozen;
    Eigen::Index states, globals;
};

/// ∫ c r dr over the flat membrane, nm².
double initial_mass(const Parameters& p) {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
    const auto integrand = [&](double r) { return initial_concentration(p.molecules, r) * r; };
    const double rim = p.domain.radius, width = 6 * p.molecules.interface_width;
    const double inner = std::clamp(p.molecules.patch_radius - width, 0.0, rim),
                 outer = std::clamp(p.molecules.patch_radius + width, 0.0, rim);
    double sum = Quadrature::integrate(integrand, inner, outer, 10, 1e-14);
    if (inner > 0) sum += Quadrature::integrate(integrand, 0.0, inner, 10, 1e-14);
    if (outer < rim) sum += Quadrature::integrate(integrand, outer, rim, 10, 1e-14);
    return sum;
}

Setting setting_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    const bool frozen = molecules_are_frozen(p);
    return {stationary.energy,
            transport_law(p.molecules),
            loads_of(p),
            p.molecules,
            p.domain.radius,
            p.domain.membrane_height,
            frozen ? 0.0 : initial_mass(p),
            frozen,
            frozen ? state::frozen_states : state::equilibrium_states,
            frozen ? 1 : 2};
}

/// c and dc/da at one point.
template <class Number>
struct Concentration {
    Number value, slope;
};

/// Those of the material with label a: c is the tanh profile in the radius ρ = √(2a) it had, dc/dρ = −√2 c (1 − c)/ε_c.
template <class Number>
Concentration<Number> frozen_concentration(const MoleculeParameters& molecules, const Number& a) {
    const double c = initial_concentration_of_material(molecules, value_of(a));
    const double rho = std::sqrt(2 * std::max(value_of(a), 0.0)), epsilon = molecules.interface_width;
    if (rho == 0) return {chain(a, c, 0), 0.0};
    const double steepness = std::numbers::sqrt2 / epsilon, by_rho = -steepness * c * (1 - c);
    const double slope = by_rho / rho;
    return {chain(a, c, slope), chain(a, slope, (-steepness * (1 - 2 * c) * slope - slope / rho) / rho)};
}

/// The states and globals as dual numbers, at one point.
struct Variables {
    std::array<Number, unknowns> y;
    Eigen::Index states;

    Variables(const Eigen::VectorXd& at, const Eigen::VectorXd& globals)
        : y(dual_unknowns<unknowns>(at, globals)), states(at.size()) {}
    const Number& operator[](Eigen::Index i) const { return y[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Number& global(Eigen::Index i) const { return y[static_cast<std::size_t>(states + i)]; }
};

/// What the equations need at one point besides the states.
template <class Number>
struct MaterialPoint {
    Concentration<Number> c;
    ElasticState<Number> elastic;
    Number stress;         // 2 (∂e/∂|∇c|²) (dc/da)², the tension of c's gradient over r², pN/nm³
    Number force, spread;  // Z and Z/r²: the resultant −F (1 − exp(−a/(πw²)))/2π of the pole force, pN and pN/nm²
};

/// `y` holds the states, `a` is the label.
template <class Number, class States>
MaterialPoint<Number> material_point(const MembraneEnergy& energy, const MoleculeParameters& molecules,
                                     const Loads& loads, bool frozen, const States& y, const Number& a) {
    MaterialPoint<Number> point;
    const bool on_axis = value_of(a) == 0;
    if (frozen)
        point.c = frozen_concentration(molecules, a);
    else
        point.c = {y[state::concentration], on_axis ? Number(0.0) : y[state::gradient] / y[state::r_squared]};
    const Number squared_slope = point.c.slope * point.c.slope;
    point.elastic =
        elastic_state(energy, Number(y[state::moment]), point.c.value, Number(y[state::r_squared] * squared_slope));
    point.stress = 2.0 * point.elastic.by_squared_gradient * squared_slope;
    point.force = (-0.5 * loads.pole_force / pi) * loads.force_within(2 * pi * a);
    point.spread = on_axis ? Number(0.0) : point.force / y[state::r_squared];
    return point;
}

/// λ = m κ1 + Q cos θ + (½ p r² − Z) κ2 + 2 (∂e/∂|∇c|²) |∇c|² − e: the first integral, from the balance along the
/// membrane.
template <class Number, class States>
Number tension(const MaterialPoint<Number>& point, const Loads& loads, const States& y) {
    const Number &hoop = y[state::hoop], &r2 = y[state::r_squared];
    return y[state::moment] * (point.elastic.curvature - hoop) + y[state::thrust] * y[state::cosine] +
           (0.5 * loads.pressure * r2 - point.force) * hoop + r2 * point.stress - point.elastic.density;
}

/// Δ_Γ c as a function of c and μ: zero of the chemical potential's deviation from its constant. Under energetic
/// coupling that is ∂e/∂c − 2 ∇_Γ·((∂e/∂|∇c|²) ∇_Γ c) over σ̂, with ∂e/∂|∇c|² = ½ σ̂ ε_c everywhere.
Number concentration_source(const Setting& setting, const MaterialPoint<Number>& point, const Number& potential) {
    const Number& c = point.c.value;
    if (setting.transport.energetic) {
        const double line_energy = setting.molecules.line_energy;
        return (point.elastic.by_concentration / line_energy - potential) / setting.molecules.interface_width;
    }
    const ValueAndDerivatives local = setting.transport.potential(c.value);
    const Number deviation = chain(c, local.value, local.first) - potential;
    if (setting.transport.edge_width == 0) {
        const double length = 0.25 * setting.rim_radius;  // any length will do: p(c) = μ everywhere
        return deviation / (length * length);
    }
    return deviation / setting.transport.edge_width;
}

SlopeValues slope(const Setting& setting, double x, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    const Variables v(states, globals);
    const auto point = material_point(setting.energy, setting.molecules, setting.loads, setting.frozen, v,
                                      Number(x * v.global(global::area)));
    const Number &y = v[state::r_squared], &w = v[state::cosine], &hoop = v[state::hoop], &m = v[state::moment],
                 &thrust = v[state::thrust];
    const Number& curvature = point.elastic.curvature;
    const Number anisotropy = (curvature - 2.0 * hoop) / y;  // (κ1 − κ2)/r²
    const double half_pressure = 0.5 * setting.loads.pressure;

    std::array<Number, static_cast<std::size_t>(state::equilibrium_states)> by_a;
    const auto set = [&](Eigen::Index i, const Number& value) { by_a[static_cast<std::size_t>(i)] = value; };
    set(state::r_squared, 2.0 * w);
    set(state::cosine, -hoop * (curvature - hoop));
    set(state::hoop, w * anisotropy);
    set(state::moment, thrust * hoop + (point.spread - half_pressure) * w);  // normal force balance, (A.25)
    set(state::thrust,
        m * anisotropy + point.stress - (point.spread + half_pressure) * hoop);  // radial force balance
    set(state::height, -hoop);
    if (!setting.frozen) {
        set(state::concentration, point.c.slope);
        set(state::gradient, concentration_source(setting, point, v.global(global::potential)));
        set(state::mass, point.c.value);
    }
    std::array<Number, unknowns> by_x;
    for (std::size_t i = 0; i < static_cast<std::size_t>(setting.states); ++i)
        by_x[i] = v.global(global::area) * by_a[i];
    return slope_values<unknowns>(by_x, setting.states, setting.globals);
}

ConditionValues conditions(const Setting& setting, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList<unknowns> list(setting.states, setting.globals);
    const Variables at_axis(first, globals);
    const auto material = [&](const Variables& v, double x) {
        return material_point(setting.energy, setting.molecules, setting.loads, setting.frozen, v,
                              Number(x * v.global(global::area)));
    };
    list.at_first(at_axis[state::r_squared]);
    list.at_first(at_axis[state::cosine] - 1.0);
    list.at_first(material(at_axis, 0).elastic.curvature - 2.0 * at_axis[state::hoop]);  // regular: κ1 = κ2

    const Variables at_rim(last, globals);
    list.at_last(at_rim[state::r_squared] - setting.rim_radius * setting.rim_radius);
    list.at_last(at_rim[state::hoop]);  // horizontal tangent
    list.at_last(tension(material(at_rim, 1), setting.loads, at_rim) - setting.loads.rim_tension);
    list.at_last(at_rim[state::height] - setting.rim_height);
    if (!setting.frozen) {
        list.at_first(at_axis[state::gradient]);
        list.at_first(at_axis[state::mass]);
        list.at_last(at_rim[state::gradient]);  // no flux
        list.at_last(at_rim[state::mass] - setting.mass);
    }
    return list.values();
}

}  // namespace

bool molecules_are_frozen(const Parameters& parameters) {
    return transport_law(parameters.molecules).mobility == 0;
}

double initial_concentration_of_material(const MoleculeParameters& molecules, double a) {
    return initial_concentration(molecules, std::sqrt(2 * std::max(a, 0.0)));
}

PointOfShape point_of_shape(const StationaryCase& stationary, double a, const Eigen::VectorXd& y) {
    const Loads loads = loads_of(stationary.parameters);
    const bool frozen = y.size() == state::frozen_states;
    const auto material = material_point(stationary.energy, stationary.parameters.molecules, loads, frozen, y, a);
    PointOfShape point{};
    point.r = std::sqrt(std::max(y(state::r_squared), 0.0));
    point.z = y(state::height);
    point.cosine = y(state::cosine);
    point.sine = y(state::hoop) * point.r;
    point.c = material.c.value;
    point.squared_gradient = y(state::r_squared) * material.c.slope * material.c.slope;
    point.total_curvature = material.elastic.curvature;
    point.energy_density = material.elastic.density;
    point.tension = tension(material, loads, y);
    point.shear = y(state::thrust) * point.sine + (material.spread - 0.5 * loads.pressure) * point.r * point.cosine;
    return point;
}

BoundaryValueProblem stationary_shapes(const CasePath& path, double typical_value, double scale) {
    BoundaryValueProblem problem;
    problem.at = [path](double value) -> Equations {
        const Setting setting = setting_of(path(value));
        return {
            [setting](double x, const Eigen::VectorXd& y, const Eigen::VectorXd& g) { return slope(setting, x, y, g); },
            [setting](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& g) {
                return conditions(setting, first, last, g);
            }};
    };
    const Parameters typical = path(typical_value).parameters;
    const double radius = typical.domain.radius, curvature = 4 / radius;
    const double stiffness = BendingModel(typical.membrane).stiffness(0).value;
    const double epsilon = typical.molecules.interface_width;
    Eigen::VectorXd states(state::equilibrium_states);
    states << radius * radius, 1, curvature, stiffness * curvature, stiffness * curvature * curvature, radius, 1,
        0.25 * radius / epsilon, 0.5 * radius * radius;
    const bool frozen = molecules_are_frozen(typical);
    problem.state_scales = states.head(frozen ? state::frozen_states : state::equilibrium_states);
    problem.global_scales = Eigen::Vector2d(0.5 * radius * radius, 1 / radius).head(frozen ? 1 : 2);
    problem.parameter_scale = scale;
    return problem;
}

Eigen::VectorXd FlatMembrane::states(double x) const {
    const double rim = parameters.domain.radius, a = 0.5 * rim * rim * x;
    const bool frozen = molecules_are_frozen(parameters);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(frozen ? state::frozen_states : state::equilibrium_states);
    y(state::r_squared) = 2 * a;
    y(state::cosine) = 1;
    y(state::height) = parameters.domain.membrane_height;
    if (!frozen) y(state::concentration) = initial_concentration_of_material(parameters.molecules, a);
    return y;
}

Eigen::VectorXd FlatMembrane::slopes(double x) const {
    const double step = 1e-6, rim = parameters.domain.radius;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(states(x).size());
    slope(state::r_squared) = rim * rim;
    if (!molecules_are_frozen(parameters)) slope = (states(x + step) - states(x - step)) / (2 * step);
    return slope;
}

Eigen::VectorXd FlatMembrane::globals() const {
    const double rim = parameters.domain.radius;
    const Eigen::Vector2d all(0.5 * rim * rim, 0);
    return all.head(molecules_are_frozen(parameters) ? 1 : 2);
}

}  // namespace endoflow::statics
