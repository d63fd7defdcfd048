#include "statics/shape_equations.h"

#include "shared/model/initial_condition.h"
#include "statics/dual_system.h"
#include "statics/point_equations.h"

namespace endoflow::statics {

namespace {

constexpr std::size_t unknowns = static_cast<std::size_t>(state::equilibrium_states) + 2;  // states and globals
using Number = Dual<unknowns>;
using std::numbers::pi;

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

MaterialPoint<Number> material_point(const Setting& setting, double x, const Variables& v) {
    return material_point(setting.material, v, x, Number(x * v.area), v.pressure);
}

SlopeValues slope(const Setting& setting, double x, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    const Variables v(setting, states, globals);
    auto by_a = slopes_by_label(setting, material_point(setting, x, v), v, v.potential);
    for (Number& value : by_a) value = v.area * value;
    return slope_values<unknowns>(by_a, setting.states, setting.globals);
}

void pole_conditions(const Setting& setting, const Variables& north, const Variables& south,
                     ConditionList<unknowns>& list) {
    for (const Eigen::Index i : {state::height, state::volume, state::energy}) list.at_first(north[i]);
    list.at_last(south[state::r_squared]);  // cos θ = −1 follows: w² + y κ2² is constant
    list.at_last(kink(material_point(setting, 1, south), south));
    list.at_last(south[state::volume] - setting.material.closed->volume / pi);
}

ConditionValues conditions(const Setting& setting, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList<unknowns> list(setting.states, setting.globals);
    const Variables axis(setting, first, globals), end(setting, last, globals);
    for (const Number& zero : axis_conditions(setting, material_point(setting, 0, axis), axis)) list.at_first(zero);
    if (setting.material.closed)
        pole_conditions(setting, axis, end, list);
    else
        for (const Number& zero : rim_conditions(setting, material_point(setting, 1, end), end)) list.at_last(zero);
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
