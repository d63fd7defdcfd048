#include "statics/held_branch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shared/parameters/parameter_table.h"
#include "statics/sampled_curve.h"

namespace endoflow::statics {

namespace {

constexpr const char* remedy = "hold the neck at another radius, or choose another patch, curvature or load";

/// A neck this much narrower than the bud can be held while the case changes.
constexpr double developed = 0.8;

/// Spontaneous curvature, in units of the case's, up to which the membrane may form a neck of its own.
constexpr double most_curvature = 4;

/// A branch that has folded is followed until the neck is this many times as wide (narrow, when it is widened) as it
/// was, for it may fold again.
constexpr double furthest_return = 2;

/// Both meridians are off the axis but for the bud's apex.
bool off_the_axis(const PiecewiseSolution& solution) {
    const Eigen::Index n = solution.nodes.rows() / 2;
    const auto bud = solution.nodes.row(state::r_squared), outer = solution.nodes.row(n + state::r_squared);
    return std::min(bud.tail(bud.size() - 1).minCoeff(), outer.minCoeff()) > 0;
}

/// Whether two pieces of the meridian cross, among 300.
bool crosses_itself(const MembraneCurve& curve) {
    const auto side = [&](std::size_t i, std::size_t j) {  // of point j, seen along the piece behind point i
        return (curve.r[i + 1] - curve.r[i]) * (curve.z[j] - curve.z[i]) -
               (curve.z[i + 1] - curve.z[i]) * (curve.r[j] - curve.r[i]);
    };
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        for (std::size_t j = i + 2; j + 1 < curve.size(); ++j)
            if (side(i, j) * side(i, j + 1) < 0 && side(j, i) * side(j, i + 1) < 0) return true;
    return false;
}

/// The last shape of the branch from the flat membrane, with a neck that is developed; empty when there is none.
std::optional<PiecewiseSolution> shape_with_neck(const Parameters& parameters, const Resolution& resolution) {
    const GaussRule rule(resolution.points);
    const auto neck_develops = [&](const BranchPoint& point) {
        const auto neck = place_of_neck(point.solution, rule);
        if (!neck) return false;
        const double narrow = evaluate(point.solution, rule, *neck)(state::r_squared);
        double wide = 0;
        for (Eigen::Index i = 0; point.solution.mesh[static_cast<std::size_t>(i)] < *neck; ++i)
            wide = std::max(wide, point.solution.nodes(state::r_squared, i));
        return narrow < developed * developed * wide;
    };
    const double sign = parameters.membrane.spontaneous_curvature < 0 ? -1 : 1;
    const auto branch = branch_from_flat(parameters, sign * most_curvature * scale_of_curvature(parameters), resolution,
                                         [&](const BranchPoint& point) { return !neck_develops(point); });
    if (!branch || branch->end != BranchEnd::stopped) return std::nullopt;
    return branch->last.solution;
}

/// The shape, which has one number of the parameter table at `begin`, with that number at `end` and the radius kept.
HeldState with_parameter(const HeldState& from, const std::string& key, double begin, double end,
                         const Resolution& resolution) {
    const double radius = from.held.radius;
    const CasePath cases = path_in(from.held.stationary.parameters, key);
    if (begin == end) return from;
    const HeldPath path = [&](double value) { return HeldCase{cases(value), radius}; };
    const GaussRule rule(resolution.points);
    const BoundaryValueProblem problem = held_shapes(path, end, std::max(std::abs(begin), std::abs(end)));
    const auto start = begin_branch_at(problem, rule, from.point.solution, resolution.elements, begin, end);
    const auto go_on = [](const BranchPoint&) { return true; };
    std::optional<Branch> branch;
    if (start) branch = follow_branch(problem, rule, *start, end, {}, off_the_axis, go_on);
    if (!branch || branch->end != BranchEnd::reached_target)
        throw SolverError("no-held-neck",
                          fmt::format("a neck held at {:.4g} nm has no shape beyond {} = {:.6g}", radius, key,
                                      branch ? branch->last.solution.parameter : begin),
                          remedy);
    return {path(end), branch->last};
}

const char* text_of(HeldFault fault) {
    switch (fault) {
        case HeldFault::open:
            return "neck and bud meet, and nothing narrow is left to hold";
        case HeldFault::narrower:
            return "another place becomes narrower than the held one";
        case HeldFault::crossing:
            return "the membrane crosses itself";
    }
    return "";
}

const char* name_of(HeldFault fault) {
    switch (fault) {
        case HeldFault::open:
            return "held-neck-opens";
        case HeldFault::narrower:
            return "second-neck";
        case HeldFault::crossing:
            return "membrane-crosses-itself";
    }
    return "";
}

HeldPath path_in_radius(const StationaryCase& stationary) {
    return [stationary](double radius) { return HeldCase{stationary, radius}; };
}

}  // namespace

std::optional<HeldFault> fault_of(const HeldCase& held, const PiecewiseSolution& solution, const GaussRule& rule) {
    const Eigen::VectorXd neck = solution.nodes.rightCols<1>().head(solution.nodes.rows() / 2);
    const PointOfShape point = point_of_shape(held.stationary, solution.globals(held_global::neck), neck);
    const double hoop = neck(state::hoop);
    // d²(r²)/da² = −2 κ1 κ2 at the vertical tangent
    if ((point.total_curvature - hoop) * hoop >= 0) return HeldFault::open;
    const PiecewiseSolution whole = joined(solution, rule);
    if (narrowest_radius(whole) < held.radius * (1 - 1e-9)) return HeldFault::narrower;
    if (crosses_itself(sampled_curve(held.stationary.parameters, whole, rule, 301))) return HeldFault::crossing;
    return std::nullopt;
}

HeldState find_held_neck(const Parameters& parameters, const Resolution& resolution) {
    Parameters free = without_loads(parameters);
    const GaussRule rule(resolution.points);
    const auto open = shape_with_neck(free, resolution);
    if (!open)
        throw SolverError("no-held-neck",
                          fmt::format("with up to {:g} times the case's spontaneous curvature the membrane forms no "
                                      "neck of its own from which a held one could be followed",
                                      most_curvature),
                          remedy);
    const double curvature = open->parameter, neck = *place_of_neck(*open, rule);
    free.membrane.spontaneous_curvature = curvature;
    const HeldCase begin{free, std::sqrt(evaluate(*open, rule, neck)(state::r_squared))};
    const PiecewiseSolution cut = cut_at_neck(*open, rule, neck, 2 * resolution.elements);
    HeldState state{begin, {cut, cut, 0, 0}};
    state = with_parameter(state, "membrane.spontaneous_curvature", curvature,
                           parameters.membrane.spontaneous_curvature, resolution);
    for (const char* key : load_keys) state = with_parameter(state, key, 0, number_of(parameters, key), resolution);
    if (const auto fault = fault_of(state.held, state.point.solution, rule))
        throw SolverError(name_of(*fault), fmt::format("at {:.6g} nm {}", state.held.radius, text_of(*fault)), remedy);
    return state;
}

HeldBranch follow_radius(const HeldState& from, double end, const HeldVisitor& visit, const Resolution& resolution) {
    const GaussRule rule(resolution.points);
    const double begin = from.held.radius;
    const HeldPath path = path_in_radius(from.held.stationary);
    const BoundaryValueProblem problem = held_shapes(path, begin, begin);
    const auto start = begin_branch_at(problem, rule, from.point.solution, resolution.elements, begin, end);
    if (!start)
        throw SolverError("no-held-neck", fmt::format("Newton's method failed at a neck of {:.6g} nm", begin), remedy);
    HeldBranch result{{*start, {}, BranchEnd::stopped}, {}, begin};
    double nearest = begin;  // to the end that the branch has come
    const auto look = [&](const BranchPoint& point) {
        const HeldState here{path(point.solution.parameter), point};
        result.fault = fault_of(here.held, point.solution, rule);
        if (result.fault) return false;
        const double radius = result.last_radius = here.held.radius;
        nearest = end < begin ? std::min(nearest, radius) : std::max(nearest, radius);
        const double returned = end < begin ? radius / nearest : nearest / radius;
        return visit(here) && returned < furthest_return;
    };
    result.branch = follow_branch(problem, rule, *start, end, {}, off_the_axis, look);
    return result;
}

SolverError held_failure(const HeldBranch& branch, double wanted) {
    const auto sentence = [&](const std::string& why) {
        return fmt::format("a neck of {:g} nm is not reached: at {:.6g} nm {}", wanted, branch.last_radius, why);
    };
    if (branch.fault) return {name_of(*branch.fault), sentence(text_of(*branch.fault)), remedy};
    if (!branch.branch.folds.empty())
        return {"no-held-neck",
                fmt::format("a neck of {:g} nm is not reached: the branch folds back at {:.8g} nm", wanted,
                            branch.branch.folds.front().parameter()),
                remedy};
    return {"no-held-neck", sentence(to_string(branch.branch.end)), remedy};
}

HeldState held_at(const HeldState& from, double radius, const Resolution& resolution) {
    if (radius == from.held.radius) return from;
    const HeldBranch found = follow_radius(
        from, radius, [](const HeldState&) { return true; }, resolution);
    if (found.fault || found.branch.end != BranchEnd::reached_target) throw held_failure(found, radius);
    return {{from.held.stationary, radius}, found.branch.last};
}

HeldState widest_held(const HeldState& from, const Resolution& resolution) {
    HeldState widest = from;
    const auto keep = [&](const HeldState& here) {
        const bool wider = here.point.folds_before == 0;
        if (wider) widest = here;
        return wider;
    };
    (void)follow_radius(from, from.held.stationary.parameters.domain.radius, keep, resolution);
    return widest;
}

std::optional<HeldState> refined_held(const HeldState& coarse, const Resolution& resolution) {
    const GaussRule rule(resolution.points);
    const double radius = coarse.held.radius;
    const BoundaryValueProblem problem = held_shapes(path_in_radius(coarse.held.stationary), radius, radius);
    const PiecewiseSolution guess = interpolate(coarse.point.solution, rule, halved_mesh(coarse.point.solution.mesh));
    auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, radius, problem), 20);
    if (!solved) return std::nullopt;
    return HeldState{
        coarse.held,
        {std::move(solved->solution), std::move(solved->tangent), coarse.point.arc_length, coarse.point.folds_before}};
}

}  // namespace endoflow::statics
