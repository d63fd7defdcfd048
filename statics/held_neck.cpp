#include "statics/held_neck.h"

#include <boost/math/tools/roots.hpp>

#include "statics/dual_system.h"
#include "statics/point_equations.h"

namespace endoflow::statics {

namespace {

using std::numbers::pi;

constexpr std::size_t globals_of_equilibrium = 4;

/// What the equations need besides a case's setting.
struct HeldSetting {
    Setting setting;
    double radius;  // of the neck, nm

    [[nodiscard]] Eigen::Index states() const { return setting.states; }  // of one of the two meridians
    [[nodiscard]] Eigen::Index globals() const { return setting.material.frozen ? 3 : 4; }
};

enum class Side { bud, outer };

/// The states of one point and the globals, as dual numbers in N variables that begin with those of `offset`.
template <class Number>
struct HeldPoint {
    const Number* states;
    Number label;    // a
    Number stretch;  // da/dx
    Number potential;
    MaterialPoint<Number> point;

    /// `globals`: those of held_global.
    HeldPoint(const HeldSetting& held, Side side, double x, const Number* of_point, const Number* globals)
        : states(of_point) {
        const Number &area = globals[held_global::area], &neck = globals[held_global::neck];
        stretch = side == Side::bud ? neck : neck - area;
        label = side == Side::bud ? x * neck : area + x * stretch;
        if (!held.setting.material.frozen) potential = globals[held_global::potential];
        const Material& material = held.setting.material;
        point = material_point(material, *this, x, label, Number(material.loads.pressure));
    }
    const Number& operator[](Eigen::Index i) const { return states[i]; }
};

/// dy/dx of the states of one meridian.
SlopeValues slope_of(const HeldSetting& held, Side side, double x, const Eigen::VectorXd& states,
                     const Eigen::VectorXd& globals) {
    constexpr std::size_t unknowns = static_cast<std::size_t>(state::equilibrium_states) + globals_of_equilibrium;
    using Number = Dual<unknowns>;
    const std::array<Number, unknowns> variables = dual_unknowns<unknowns>(states, globals);
    const HeldPoint<Number> at(held, side, x, variables.data(), variables.data() + states.size());
    auto by_a = slopes_by_label(held.setting, at.point, at, at.potential);
    for (Number& value : by_a) value = at.stretch * value;
    return slope_values<unknowns>(by_a, states.size(), globals.size());
}

SlopeValues slope(const HeldSetting& held, double x, const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    const Eigen::Index n = held.states();
    const SlopeValues bud = slope_of(held, Side::bud, x, states.head(n), globals),
                      outer = slope_of(held, Side::outer, x, states.tail(n), globals);
    SlopeValues both{Eigen::VectorXd(2 * n), Eigen::MatrixXd::Zero(2 * n, 2 * n),
                     Eigen::MatrixXd(2 * n, globals.size())};
    both.value << bud.value, outer.value;
    both.by_state.topLeftCorner(n, n) = bud.by_state;
    both.by_state.bottomRightCorner(n, n) = outer.by_state;
    both.by_global << bud.by_global, outer.by_global;
    return both;
}

ConditionValues conditions(const HeldSetting& held, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    constexpr std::size_t unknowns = 2 * static_cast<std::size_t>(state::equilibrium_states) + globals_of_equilibrium;
    using Number = Dual<unknowns>;
    using Point = HeldPoint<Number>;
    const Eigen::Index n = held.states();
    ConditionList<unknowns> list(2 * n, globals.size());

    const auto ends = dual_unknowns<unknowns>(first, globals), neck = dual_unknowns<unknowns>(last, globals);
    const Number *end_globals = ends.data() + 2 * n, *neck_globals = neck.data() + 2 * n;
    const Point axis(held, Side::bud, 0, ends.data(), end_globals),
        rim(held, Side::outer, 0, ends.data() + n, end_globals);
    for (const Number& zero : axis_conditions(held.setting, axis.point, axis)) list.at_first(zero);
    for (const Number& zero : rim_conditions(held.setting, rim.point, rim)) list.at_first(zero);

    const Number *bud = neck.data(), *outer = neck.data() + n;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Number jump = i == state::thrust ? neck_globals[held_global::force] / (2 * pi * held.radius) : Number(0);
        list.at_last(outer[i] - bud[i] + jump);
    }
    list.at_last(bud[state::cosine]);  // vertical tangent
    list.at_last(bud[state::r_squared] - held.radius * held.radius);
    return list.values();
}

}  // namespace

BoundaryValueProblem held_shapes(const HeldPath& path, double typical_value, double scale) {
    const CasePath cases = [path](double value) { return path(value).stationary; };
    const BoundaryValueProblem whole = stationary_shapes(cases, typical_value, scale);
    BoundaryValueProblem problem;
    problem.at = [path](double value) -> Equations {
        const HeldCase at = path(value);
        const HeldSetting held{setting_of(at.stationary), at.radius};
        return {[held](double x, const Eigen::VectorXd& y, const Eigen::VectorXd& g) { return slope(held, x, y, g); },
                [held](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& g) {
                    return conditions(held, first, last, g);
                }};
    };
    problem.parameter_scale = scale;
    problem.state_scales.resize(2 * whole.states());
    problem.state_scales << whole.state_scales, whole.state_scales;
    problem.global_scales.resize(whole.globals() + 2);
    problem.global_scales(held_global::area) = whole.global_scales(global::area);
    problem.global_scales(held_global::neck) = whole.global_scales(global::area);
    const Parameters typical = cases(typical_value).parameters;
    problem.global_scales(held_global::force) =
        8 * pi * BendingModel(typical.membrane).stiffness(1).value / typical.domain.radius;
    if (whole.globals() == 2) problem.global_scales(held_global::potential) = whole.global_scales(global::potential);
    return problem;
}

PiecewiseSolution joined(const PiecewiseSolution& held, const GaussRule& rule) {
    const Eigen::Index n = held.nodes.rows() / 2, k = rule.points;
    const auto elements = static_cast<Eigen::Index>(held.elements());
    const double part = held.globals(held_global::neck) / held.globals(held_global::area), rest = 1 - part;
    PiecewiseSolution whole{
        {}, Eigen::MatrixXd(n, 2 * elements + 1), {}, Eigen::VectorXd(held.globals.size() - 2), held.parameter};
    for (const double x : held.mesh) whole.mesh.push_back(part * x);
    whole.nodes.leftCols(elements + 1) = held.nodes.topRows(n);
    whole.nodes.rightCols(elements + 1) = held.nodes.bottomRows(n).rowwise().reverse();
    for (const Eigen::MatrixXd& slopes : held.slopes) whole.slopes.emplace_back(slopes.topRows(n) / part);
    for (std::size_t i = held.elements(); i-- > 0;) {
        whole.mesh.push_back(i == 0 ? 1 : 1 - rest * held.mesh[i]);
        whole.slopes.emplace_back(held.slopes[i].bottomRows(n).leftCols(k).rowwise().reverse() / -rest);
    }
    whole.globals(global::area) = held.globals(held_global::area);
    if (whole.globals.size() == 2) whole.globals(global::potential) = held.globals(held_global::potential);
    return whole;
}

PiecewiseSolution cut_at_neck(const PiecewiseSolution& solution, const GaussRule& rule, double x_n,
                              std::size_t elements) {
    std::vector<double> mesh;
    for (std::size_t i = 0; i <= elements; ++i) mesh.push_back(static_cast<double>(i) / static_cast<double>(elements));
    const auto both = [](const Eigen::VectorXd& bud, const Eigen::VectorXd& outer) {
        Eigen::VectorXd result(bud.size() + outer.size());
        result << bud, outer;
        return result;
    };
    const auto states = [&](double x) {
        return both(evaluate(solution, rule, x_n * x), evaluate(solution, rule, 1 - (1 - x_n) * x));
    };
    const auto slopes = [&](double x) {
        return both(x_n * slope_at(solution, rule, x_n * x), -(1 - x_n) * slope_at(solution, rule, 1 - (1 - x_n) * x));
    };
    Eigen::VectorXd globals = Eigen::VectorXd::Zero(solution.globals.size() + 2);
    globals(held_global::area) = solution.globals(global::area);
    globals(held_global::neck) = x_n * solution.globals(global::area);
    if (solution.globals.size() == 2) globals(held_global::potential) = solution.globals(global::potential);
    return sample(mesh, rule, states, slopes, globals, solution.parameter);
}

std::optional<double> place_of_neck(const PiecewiseSolution& solution, const GaussRule& rule) {
    const auto cosine = [&](double x) { return evaluate(solution, rule, x)(state::cosine); };
    std::optional<double> narrowest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solution.elements(); ++i) {
        const double first = cosine(solution.mesh[i]), last = cosine(solution.mesh[i + 1]);
        if (first >= 0 || last < 0) continue;
        std::uintmax_t evaluations = 60;
        const auto place =
            boost::math::tools::toms748_solve(cosine, solution.mesh[i], solution.mesh[i + 1], first, last,
                                              boost::math::tools::eps_tolerance<double>(50), evaluations);
        const double x = 0.5 * (place.first + place.second), y = evaluate(solution, rule, x)(state::r_squared);
        if (y < least) {
            least = y;
            narrowest = x;
        }
    }
    return narrowest;
}

}  // namespace endoflow::statics
