#include "boundary_integral/statics/shape_equations.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/statics/dual.h"
#include "shared/model/double_well.h"
#include "shared/model/initial_condition.h"

namespace endoflow::statics {

namespace {

using Number = Dual<static_cast<std::size_t>(state::equilibrium_states) + 2>;  // all states and globals as variables

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
    std::array<Number, static_cast<std::size_t>(state::equilibrium_states)> y;
    std::array<Number, 2> g;

    Variables(const Setting& setting, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
        for (Eigen::Index i = 0; i < setting.states; ++i)
            y[static_cast<std::size_t>(i)] = Number::variable(states(i), static_cast<std::size_t>(i));
        for (Eigen::Index i = 0; i < setting.globals; ++i)
            g[static_cast<std::size_t>(i)] =
                Number::variable(globals(i), static_cast<std::size_t>(state::equilibrium_states + i));
    }
    const Number& operator[](Eigen::Index i) const { return y[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Number& global(Eigen::Index i) const { return g[static_cast<std::size_t>(i)]; }
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
    const Variables v(setting, states, globals);
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
    SlopeValues result{Eigen::VectorXd(setting.states), Eigen::MatrixXd(setting.states, setting.states),
                       Eigen::MatrixXd(setting.states, setting.globals)};
    for (Eigen::Index i = 0; i < setting.states; ++i) {
        const Number by_x = v.global(global::area) * by_a[static_cast<std::size_t>(i)];
        result.value(i) = by_x.value;
        for (Eigen::Index j = 0; j < setting.states; ++j)
            result.by_state(i, j) = by_x.partial[static_cast<std::size_t>(j)];
        for (Eigen::Index j = 0; j < setting.globals; ++j)
            result.by_global(i, j) = by_x.partial[static_cast<std::size_t>(state::equilibrium_states + j)];
    }
    return result;
}

/// λ = m κ1 + Q cos θ − m²/(2β)
Number tension(const Curvature& curvature, const Number& m, const Number& hoop, const Number& thrust, const Number& w) {
    return m * (curvature.total - hoop) + thrust * w - 0.5 * m * m / curvature.stiffness;
}

/// Collects conditions with their derivatives by the states at one end and by the globals.
struct ConditionList {
    const Setting& setting;
    ConditionValues values;
    Eigen::Index next = 0;

    explicit ConditionList(const Setting& s) : setting(s) {
        const Eigen::Index count = s.states + s.globals;
        values = {Eigen::VectorXd(count), Eigen::MatrixXd::Zero(count, s.states),
                  Eigen::MatrixXd::Zero(count, s.states), Eigen::MatrixXd::Zero(count, s.globals)};
    }
    void add(Eigen::MatrixXd ConditionValues::*end, const Number& residual) {
        values.value(next) = residual.value;
        for (Eigen::Index j = 0; j < setting.states; ++j)
            (values.*end)(next, j) = residual.partial[static_cast<std::size_t>(j)];
        for (Eigen::Index j = 0; j < setting.globals; ++j)
            values.by_global(next, j) = residual.partial[static_cast<std::size_t>(state::equilibrium_states + j)];
        ++next;
    }
};

ConditionValues conditions(const Setting& setting, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList list(setting);
    const auto axis = &ConditionValues::by_first, rim = &ConditionValues::by_last;

    const Variables at_axis(setting, first, globals);
    const Curvature apex(setting, at_axis.concentration(setting, 0), at_axis[state::moment]);
    list.add(axis, at_axis[state::r_squared]);
    list.add(axis, at_axis[state::cosine] - 1.0);
    list.add(axis, apex.total - 2.0 * at_axis[state::hoop]);  // regular: both principal curvatures are equal

    const Variables at_rim(setting, last, globals);
    const Curvature end(setting, at_rim.concentration(setting, 1), at_rim[state::moment]);
    list.add(rim, at_rim[state::r_squared] - setting.rim_radius * setting.rim_radius);
    list.add(rim, at_rim[state::hoop]);  // horizontal tangent
    list.add(rim,
             tension(end, at_rim[state::moment], at_rim[state::hoop], at_rim[state::thrust], at_rim[state::cosine]));
    list.add(rim, at_rim[state::height] - setting.rim_height);
    if (!setting.frozen) {
        list.add(axis, at_axis[state::gradient]);
        list.add(axis, at_axis[state::mass]);
        list.add(rim, at_rim[state::gradient]);  // no flux
        list.add(rim, at_rim[state::mass] - setting.mass);
    }
    return list.values;
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
