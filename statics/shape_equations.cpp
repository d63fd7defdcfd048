#include "statics/shape_equations.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <optional>

#include "shared/model/initial_condition.h"
#include "shared/model/loads.h"
#include "shared/model/transport_law.h"
#include "statics/dual_system.h"

namespace endoflow::statics {

namespace {

constexpr std::size_t unknowns = static_cast<std::size_t>(state::equilibrium_states) + 2;  // states and globals
using Number = Dual<unknowns>;
using std::numbers::pi;

/// What the membrane is at each of its points.
struct Material {
    MembraneEnergy energy;
    MoleculeParameters molecules;
    Loads loads;
    bool frozen;                           // the molecules
    std::optional<ClosedMembrane> closed;  // instead of all of the above
};

/// What a case says to the equations.
struct Setting {
    Material material;
    TransportLaw transport;
    double rim_radius, rim_height;
    double mass;  // ∫ c da of the initial membrane, nm²
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

Material material_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    return {stationary.energy, p.molecules, loads_of(p), molecules_are_frozen(p), {}};
}

Setting setting_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    const bool frozen = molecules_are_frozen(p);
    return {material_of(stationary),
            transport_law(p.molecules),
            p.domain.radius,
            p.domain.membrane_height,
            frozen ? 0.0 : initial_mass(p),
            frozen ? state::frozen_states : state::equilibrium_states,
            frozen ? 1 : 2};
}

Setting setting_of(const ClosedMembrane& membrane) {
    return {{{}, {}, {}, true, membrane}, {}, 0, 0, 0, state::closed_states, 1};
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
    Number area;      // E, nm²
    Number pressure;  // p: below minus above or inside minus outside, pN/nm²
    Number potential;

    Variables(const Setting& setting, const Eigen::VectorXd& at, const Eigen::VectorXd& globals)
        : y(dual_unknowns<unknowns>(at, globals)) {
        const auto global = [&](Eigen::Index i) { return y[static_cast<std::size_t>(at.size() + i)]; };
        const std::optional<ClosedMembrane>& closed = setting.material.closed;
        area = closed ? Number(closed->area / (2 * pi)) : global(global::area);
        pressure = closed ? global(global::pressure) : Number(setting.material.loads.pressure);
        if (setting.globals == 2) potential = global(global::potential);
    }
    const Number& operator[](Eigen::Index i) const { return y[static_cast<std::size_t>(i)]; }
};

/// What the equations need at one point besides the states.
template <class Number>
struct MaterialPoint {
    Concentration<Number> c;
    ElasticState<Number> elastic;
    Number pressure;       // p, pN/nm²
    Number stress;         // 2 (∂e/∂|∇c|²) (dc/da)², the tension of c's gradient over r², pN/nm³
    Number force, spread;  // Z and Z/r²: the resultant −F (1 − exp(−a/(πw²)))/2π of the pole force, pN and pN/nm²
};

/// `y` holds the states at x = a/E, `a` is the label.
template <class Number, class States>
MaterialPoint<Number> material_point(const Material& material, const States& y, double x, const Number& a,
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
    point.force = (-0.5 * material.loads.pole_force / pi) * material.loads.force_within(2 * pi * a);
    point.spread = on_axis ? Number(0.0) : point.force / y[state::r_squared];
    return point;
}

MaterialPoint<Number> material_point(const Setting& setting, double x, const Variables& v) {
    return material_point(setting.material, v, x, Number(x * v.area), v.pressure);
}

/// λ = m κ1 + Q cos θ + (½ p r² − Z) κ2 + 2 (∂e/∂|∇c|²) |∇c|² − e: the first integral, from the balance along the
/// membrane.
template <class Number, class States>
Number tension(const MaterialPoint<Number>& point, const States& y) {
    const Number &hoop = y[state::hoop], &r2 = y[state::r_squared];
    return y[state::moment] * (point.elastic.curvature - hoop) + y[state::thrust] * y[state::cosine] +
           (0.5 * point.pressure * r2 - point.force) * hoop + r2 * point.stress - point.elastic.density;
}

/// Δ_Γ c as a function of c and μ: zero of the chemical potential's deviation from its constant. Under energetic
/// coupling that is ∂e/∂c − 2 ∇_Γ·((∂e/∂|∇c|²) ∇_Γ c) over σ̂, with ∂e/∂|∇c|² = ½ σ̂ ε_c everywhere.
Number concentration_source(const Setting& setting, const MaterialPoint<Number>& point, const Number& potential) {
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

SlopeValues slope(const Setting& setting, double x, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    const Variables v(setting, states, globals);
    const auto point = material_point(setting, x, v);
    const Number &y = v[state::r_squared], &w = v[state::cosine], &hoop = v[state::hoop], &m = v[state::moment],
                 &thrust = v[state::thrust];
    const Number& curvature = point.elastic.curvature;
    const Number anisotropy = (curvature - 2.0 * hoop) / y;  // (κ1 − κ2)/r²
    const Number half_pressure = 0.5 * point.pressure;

    std::array<Number, unknowns> by_a;
    const auto set = [&](Eigen::Index i, const Number& value) { by_a[static_cast<std::size_t>(i)] = value; };
    set(state::r_squared, 2.0 * w);
    set(state::cosine, -hoop * (curvature - hoop));
    set(state::hoop, w * anisotropy);
    set(state::moment, thrust * hoop + (point.spread - half_pressure) * w);  // normal force balance, (A.25)
    set(state::thrust,
        m * anisotropy + point.stress - (point.spread + half_pressure) * hoop);  // radial force balance
    set(state::height, -hoop);
    if (setting.material.closed) {
        set(state::volume, y * hoop);
        set(state::energy, point.elastic.density);
    } else if (!setting.material.frozen) {
        set(state::concentration, point.c.slope);
        set(state::gradient, concentration_source(setting, point, v.potential));
        set(state::mass, point.c.value);
    }
    for (Number& value : by_a) value = v.area * value;
    return slope_values<unknowns>(by_a, setting.states, setting.globals);
}

/// Zero where the meridian is smooth on the axis: κ1 = κ2.
Number kink(const Setting& setting, double x, const Variables& v) {
    return material_point(setting, x, v).elastic.curvature - 2.0 * v[state::hoop];
}

void rim_conditions(const Setting& setting, const Variables& axis, const Variables& rim,
                    ConditionList<unknowns>& list) {
    list.at_last(rim[state::r_squared] - setting.rim_radius * setting.rim_radius);
    list.at_last(rim[state::hoop]);  // horizontal tangent
    list.at_last(tension(material_point(setting, 1, rim), rim) - setting.material.loads.rim_tension);
    list.at_last(rim[state::height] - setting.rim_height);
    if (setting.material.frozen) return;
    list.at_first(axis[state::gradient]);
    list.at_first(axis[state::mass]);
    list.at_last(rim[state::gradient]);  // no flux
    list.at_last(rim[state::mass] - setting.mass);
}

void pole_conditions(const Setting& setting, const Variables& north, const Variables& south,
                     ConditionList<unknowns>& list) {
    for (const Eigen::Index i : {state::height, state::volume, state::energy}) list.at_first(north[i]);
    list.at_last(south[state::r_squared]);  // cos θ = −1 follows: w² + y κ2² is constant
    list.at_last(kink(setting, 1, south));
    list.at_last(south[state::volume] - setting.material.closed->volume / pi);
}

ConditionValues conditions(const Setting& setting, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList<unknowns> list(setting.states, setting.globals);
    const Variables axis(setting, first, globals), end(setting, last, globals);
    list.at_first(axis[state::r_squared]);
    list.at_first(axis[state::cosine] - 1.0);
    list.at_first(kink(setting, 0, axis));
    if (setting.material.closed)
        pole_conditions(setting, axis, end, list);
    else
        rim_conditions(setting, axis, end, list);
    return list.values();
}

template <class Path>
BoundaryValueProblem problem_along(const Path& path, double scale) {
    BoundaryValueProblem problem;
    problem.at = [path](double value) -> Equations {
        const Setting setting = setting_of(path(value));
        return {
            [setting](double x, const Eigen::VectorXd& y, const Eigen::VectorXd& g) { return slope(setting, x, y, g); },
            [setting](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& g) {
                return conditions(setting, first, last, g);
            }};
    };
    problem.parameter_scale = scale;
    return problem;
}

PointOfShape point_of(const MaterialPoint<double>& point, const Eigen::VectorXd& y) {
    const double r2 = y(state::r_squared), r = std::sqrt(std::max(r2, 0.0));
    const double cosine = y(state::cosine), sine = y(state::hoop) * r;
    return {r,
            y(state::height),
            cosine,
            sine,
            point.c.value,
            r2 * point.c.slope * point.c.slope,
            point.elastic.curvature,
            tension(point, y),
            point.elastic.density,
            y(state::thrust) * sine + (point.spread - 0.5 * point.pressure) * r * cosine};
}

}  // namespace

bool molecules_are_frozen(const Parameters& parameters) {
    return transport_law(parameters.molecules).mobility == 0;
}

double initial_concentration_of_material(const MoleculeParameters& molecules, double a) {
    return initial_concentration(molecules, std::sqrt(2 * std::max(a, 0.0)));
}

PointOfShape point_of_shape(const StationaryCase& stationary, double a, const Eigen::VectorXd& y) {
    const Material material = material_of(stationary);
    return point_of(material_point(material, y, 0, a, material.loads.pressure), y);
}

PointOfShape point_of_vesicle(const ClosedMembrane& membrane, double pressure, double x, const Eigen::VectorXd& y) {
    return point_of(material_point(setting_of(membrane).material, y, x, 0.0, pressure), y);
}

BoundaryValueProblem stationary_shapes(const CasePath& path, double typical_value, double scale) {
    BoundaryValueProblem problem = problem_along(path, scale);
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
    return problem;
}

BoundaryValueProblem stationary_shapes(const MembranePath& path, double typical_value, double scale) {
    BoundaryValueProblem problem = problem_along(path, scale);
    const ClosedMembrane typical = path(typical_value);
    const double radius = typical.sphere_radius(), beta = typical.stiffness();
    problem.state_scales.resize(state::closed_states);
    problem.state_scales << radius * radius, 1, 1 / radius, beta / radius, 4 * beta / (radius * radius), radius,
        std::pow(radius, 3), beta;
    problem.global_scales = Eigen::VectorXd::Constant(1, 10 * beta / std::pow(radius, 3));
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
