#include "statics/shape_equations.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "shared/model/double_well.h"
#include "shared/model/initial_condition.h"
#include "statics/dual_system.h"

namespace endoflow::statics {

namespace {

constexpr std::size_t unknowns = static_cast<std::size_t>(state::equilibrium_states) + 2;  // states and globals
using Number = Dual<unknowns>;

/// What a case's parameters say to the equations.
struct Setting {
    BendingModel bending;
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

Setting setting_of(const Parameters& p) {
    const bool frozen = molecules_are_frozen(p);
    return {BendingModel(p.membrane),
            p.molecules,
            p.domain.radius,
            p.domain.membrane_height,
            frozen ? 0.0 : initial_mass(p),
            frozen,
            frozen ? state::frozen_states : state::equilibrium_states,
            frozen ? 1 : 2};
}

Number frozen_concentration(const MoleculeParameters& molecules, const Number& a) {
    const double c = initial_concentration_of_material(molecules, a.value);
    const double initial_radius = std::sqrt(2 * a.value);  // dc/dr = −√2 c (1 − c)/ε_c for the tanh profile
    const double slope =
        initial_radius > 0 ? -std::numbers::sqrt2 * c * (1 - c) / (molecules.interface_width * initial_radius) : 0;
    return Number::chain(c, slope, a);
}

/// The states and globals as dual numbers, at one point.
struct Variables {
    std::array<Number, unknowns> y;
    Eigen::Index states;

    Variables(const Eigen::VectorXd& at, const Eigen::VectorXd& globals)
        : y(dual_unknowns<unknowns>(at, globals)), states(at.size()) {}
    const Number& operator[](Eigen::Index i) const { return y[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Number& global(Eigen::Index i) const { return y[static_cast<std::size_t>(states + i)]; }
    [[nodiscard]] Number concentration(const Setting& setting, double x) const {
        return setting.frozen ? frozen_concentration(setting.molecules, x * global(global::area))
                              : y[static_cast<std::size_t>(state::concentration)];
    }
};

/// β(c) and κ = C(c) + m/β(c).
struct Curvature {
    Number stiffness, total;

    Curvature(const Setting& setting, const Number& c, const Number& moment) {
        const auto beta = setting.bending.stiffness(c.value),
                   spontaneous = setting.bending.spontaneous_curvature(c.value);
        stiffness = Number::chain(beta.value, beta.first, c);
        total = Number::chain(spontaneous.value, spontaneous.first, c) + moment / stiffness;
    }
};

/// Δ_Γ c as a function of c and μ: zero of the chemical potential's deviation from its constant.
Number concentration_source(const Setting& setting, const Number& c, const Number& potential) {
    if (setting.molecules.transport == Transport::fickian) {
        const double length = 0.25 * setting.rim_radius;  // any length will do: c = μ everywhere
        return (c - potential) / Number(length * length);
    }
    const auto well = double_well(c.value);  // (24): −ε Δ_Γ c + W'(c)/ε = μ
    const double epsilon = setting.molecules.interface_width;
    return (Number::chain(well.first, well.second, c) / Number(epsilon) - potential) / Number(epsilon);
}

SlopeValues slope(const Setting& setting, double x, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    const Variables v(states, globals);
    const Number c = v.concentration(setting, x);
    const Number &y = v[state::r_squared], &w = v[state::cosine], &hoop = v[state::hoop], &m = v[state::moment],
                 &thrust = v[state::thrust];
    const Curvature curvature(setting, c, m);
    const Number anisotropy = (curvature.total - 2.0 * hoop) / y;  // (κ1 − κ2)/r²

    std::array<Number, static_cast<std::size_t>(state::equilibrium_states)> by_a;
    const auto set = [&](Eigen::Index i, const Number& value) { by_a[static_cast<std::size_t>(i)] = value; };
    set(state::r_squared, 2.0 * w);
    set(state::cosine, -hoop * (curvature.total - hoop));
    set(state::hoop, w * anisotropy);
    set(state::moment, thrust * hoop);   // normal force balance, (A.25)
    set(state::thrust, m * anisotropy);  // radial force balance
    set(state::height, -hoop);
    if (!setting.frozen) {
        set(state::concentration, v[state::gradient] / y);
        set(state::gradient, concentration_source(setting, c, v.global(global::potential)));
        set(state::mass, c);
    }
    std::array<Number, unknowns> by_x;
    for (std::size_t i = 0; i < static_cast<std::size_t>(setting.states); ++i)
        by_x[i] = v.global(global::area) * by_a[i];
    return slope_values<unknowns>(by_x, setting.states, setting.globals);
}

/// λ = m κ1 + Q cos θ − m²/(2β)
Number tension(const Curvature& curvature, const Number& m, const Number& hoop, const Number& thrust, const Number& w) {
    return m * (curvature.total - hoop) + thrust * w - 0.5 * m * m / curvature.stiffness;
}

ConditionValues conditions(const Setting& setting, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList<unknowns> list(setting.states, setting.globals);
    const Variables at_axis(first, globals);
    const Curvature apex(setting, at_axis.concentration(setting, 0), at_axis[state::moment]);
    list.at_first(at_axis[state::r_squared]);
    list.at_first(at_axis[state::cosine] - 1.0);
    list.at_first(apex.total - 2.0 * at_axis[state::hoop]);  // regular: both principal curvatures are equal

    const Variables at_rim(last, globals);
    const Curvature end(setting, at_rim.concentration(setting, 1), at_rim[state::moment]);
    list.at_last(at_rim[state::r_squared] - setting.rim_radius * setting.rim_radius);
    list.at_last(at_rim[state::hoop]);  // horizontal tangent
    list.at_last(
        tension(end, at_rim[state::moment], at_rim[state::hoop], at_rim[state::thrust], at_rim[state::cosine]));
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
    return parameters.molecules.transport == Transport::advection;
}

double initial_concentration_of_material(const MoleculeParameters& molecules, double a) {
    return initial_concentration(molecules, std::sqrt(2 * std::max(a, 0.0)));
}

PointOfShape point_of_shape(const BendingModel& bending, const MoleculeParameters& molecules, double a,
                            const Eigen::VectorXd& y) {
    const bool frozen = y.size() == state::frozen_states;
    PointOfShape point{};
    point.r = std::sqrt(std::max(y(state::r_squared), 0.0));
    point.z = y(state::height);
    point.cosine = y(state::cosine);
    point.sine = y(state::hoop) * point.r;
    point.c = frozen ? initial_concentration_of_material(molecules, a) : y(state::concentration);
    const double beta = bending.stiffness(point.c).value, m = y(state::moment);
    point.total_curvature = bending.spontaneous_curvature(point.c).value + m / beta;
    point.energy_density = 0.5 * m * m / beta;
    point.tension =
        m * (point.total_curvature - y(state::hoop)) + y(state::thrust) * point.cosine - point.energy_density;
    point.shear = y(state::thrust) * point.sine;
    return point;
}

BoundaryValueProblem stationary_shapes(const ParameterPath& path, double typical_value, double scale) {
    BoundaryValueProblem problem;
    problem.at = [path](double value) -> Equations {
        const Setting setting = setting_of(path(value));
        return {
            [setting](double x, const Eigen::VectorXd& y, const Eigen::VectorXd& g) { return slope(setting, x, y, g); },
            [setting](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& g) {
                return conditions(setting, first, last, g);
            }};
    };
    const Parameters typical = path(typical_value);
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
