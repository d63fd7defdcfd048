#include "statics/continuation.h"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace endoflow::statics {

namespace {

constexpr int first_iterations = 50;
constexpr int corrector_iterations = 10;
constexpr int easy_iterations = 5;
constexpr int points_per_mesh = 3;

/// A point and how hard it was to find.
struct Found {
    BranchPoint point;
    int iterations;
};

/// The point of the branch at this distance along the tangent of `from`.
std::optional<Found> point_ahead(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& from,
                                 double distance) {
    PiecewiseSolution guess = from.solution;
    guess.add(distance, from.tangent);
    auto corrected = solve_newton(problem, rule, guess, BranchCondition{from.tangent, from.solution, distance},
                                  corrector_iterations);
    if (!corrected) return std::nullopt;
    return Found{
        {std::move(corrected->solution), std::move(corrected->tangent), from.arc_length + distance, from.folds_before},
        corrected->iterations};
}

/// The same, unless it is not admissible or the branch turns too much on the way.
std::optional<Found> next_point(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& from,
                                double distance, const ContinuationSettings& settings, const Admissible& admissible) {
    auto next = point_ahead(problem, rule, from, distance);
    if (!next || !admissible(next->point.solution)) return std::nullopt;
    const double cosine = inner_product(next->point.tangent, from.tangent, problem);
    return cosine < settings.least_cosine ? std::nullopt : std::move(next);
}

/// The same point on a mesh that fits it.
std::optional<BranchPoint> adapted(const BoundaryValueProblem& problem, const GaussRule& rule,
                                   const BranchPoint& point) {
    const auto mesh = equidistributed_mesh(point.solution, rule, problem.state_scales, point.solution.elements());
    const BranchPoint moved{interpolate(point.solution, rule, mesh), interpolate(point.tangent, rule, mesh),
                            point.arc_length, point.folds_before};
    auto settled = point_ahead(problem, rule, moved, 0);
    if (!settled) return std::nullopt;
    return std::move(settled->point);
}

/// The fold between `from` and the point at `distance`, where the parameter's part of the tangent changes its sign.
std::optional<Fold> locate_fold(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& from,
                                double distance, double tangent_there) {
    std::optional<Found> nearest;
    const auto tangent_at = [&](double length) {
        nearest = point_ahead(problem, rule, from, length);
        if (!nearest) throw std::domain_error("the corrector failed next to a fold");
        return nearest->point.tangent.parameter;
    };
    try {
        std::uintmax_t evaluations = 30;
        const auto close_enough = [&](double a, double b) { return std::abs(a - b) < 1e-7 * distance; };
        const auto bracket = boost::math::tools::toms748_solve(tangent_at, 0.0, distance, from.tangent.parameter,
                                                               tangent_there, close_enough, evaluations);
        tangent_at(0.5 * (bracket.first + bracket.second));
    } catch (const std::domain_error&) {
        return std::nullopt;
    }
    return Fold{std::move(nearest->point)};
}

/// The point with parameter = target between `before` and the point at `distance`. Found by bisection along the branch
/// first, so that Newton's method starts near it also when a fold is close.
std::optional<Found> arrival(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& before,
                             double distance, double target) {
    std::optional<Found> nearest;
    double lower = 0, upper = distance;
    const double sign = before.solution.parameter < target ? 1 : -1;
    for (int i = 0; i < 6; ++i) {
        const double middle = 0.5 * (lower + upper);
        nearest = point_ahead(problem, rule, before, middle);
        if (!nearest) return std::nullopt;
        (sign * (nearest->point.solution.parameter - target) < 0 ? lower : upper) = middle;
    }
    BranchPoint& point = nearest->point;
    auto solved = solve_newton(problem, rule, point.solution, parameter_condition(point.solution, target, problem),
                               2 * corrector_iterations);
    if (!solved) return std::nullopt;
    if (inner_product(solved->tangent, point.tangent, problem) < 0) solved->tangent.scale(-1);
    point.solution = std::move(solved->solution);
    point.solution.parameter = target;
    point.tangent = std::move(solved->tangent);
    return nearest;
}

}  // namespace

std::string to_string(BranchEnd end) {
    switch (end) {
        case BranchEnd::reached_target:
            return "reached the target";
        case BranchEnd::returned:
            return "returned to the start";
        case BranchEnd::stopped:
            return "stopped";
        case BranchEnd::no_progress:
            return "the branch ends";
        case BranchEnd::too_long:
            return "too many points";
    }
    return "unknown";
}

std::optional<BranchPoint> begin_branch(const BoundaryValueProblem& problem, const GaussRule& rule,
                                        const PiecewiseSolution& guess, double target) {
    const auto solve_from = [&](const PiecewiseSolution& near) {
        return solve_newton(problem, rule, near, parameter_condition(near, guess.parameter, problem), first_iterations);
    };
    auto solved = solve_from(guess);
    if (!solved) return std::nullopt;
    const auto mesh = equidistributed_mesh(solved->solution, rule, problem.state_scales, guess.elements());
    if (auto again = solve_from(interpolate(solved->solution, rule, mesh))) solved = std::move(again);
    if (solved->tangent.parameter * (target - guess.parameter) < 0) solved->tangent.scale(-1);
    solved->solution.parameter = guess.parameter;
    return BranchPoint{std::move(solved->solution), std::move(solved->tangent), 0, 0};
}

std::optional<BranchPoint> begin_branch_at(const BoundaryValueProblem& problem, const GaussRule& rule,
                                           const PiecewiseSolution& solution, std::size_t elements, double parameter,
                                           double target) {
    const GaussRule rule_of_solution(static_cast<int>(solution.slopes.front().cols()));
    const auto mesh = equidistributed_mesh(solution, rule_of_solution, problem.state_scales, elements);
    PiecewiseSolution guess = resample(solution, rule_of_solution, mesh, rule);
    guess.parameter = parameter;
    return begin_branch(problem, rule, guess, target);
}

Branch follow_branch(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& start,
                     double target, const ContinuationSettings& settings, const Admissible& admissible,
                     const Visitor& visit) {
    Branch branch{start, {}, BranchEnd::too_long};
    const double begin = start.solution.parameter, sign = target > begin ? 1 : -1;
    double step = settings.first_step;
    if (!visit(start)) branch.end = BranchEnd::stopped;
    for (int count = 1; count < settings.most_points && branch.end == BranchEnd::too_long;) {
        if (step < settings.shortest_step) {
            branch.end = BranchEnd::no_progress;
            break;
        }
        auto next = next_point(problem, rule, branch.last, step, settings, admissible);
        const bool arrives = next && sign * (next->point.solution.parameter - target) >= 0;
        if (arrives) next = arrival(problem, rule, branch.last, step, target);
        const bool turns = next && !arrives && next->point.tangent.parameter * branch.last.tangent.parameter < 0;
        auto fold = turns ? locate_fold(problem, rule, branch.last, step, next->point.tangent.parameter) : std::nullopt;
        if (!next || (turns && !fold)) {  // a corrector failed: nearer to the last point it does not
            step *= 0.5;
            continue;
        }
        if (fold) {
            branch.folds.push_back(std::move(*fold));
            ++next->point.folds_before;
        }
        branch.last = std::move(next->point);
        if (!arrives && count % points_per_mesh == 0)
            if (auto settled = adapted(problem, rule, branch.last)) branch.last = std::move(*settled);
        ++count;
        if (!visit(branch.last)) branch.end = BranchEnd::stopped;
        if (sign * (branch.last.solution.parameter - begin) < 0) branch.end = BranchEnd::returned;
        if (arrives) branch.end = BranchEnd::reached_target;
        if (next->iterations <= easy_iterations) step = std::min(1.5 * step, settings.longest_step);
    }
    return branch;
}

}  // namespace endoflow::statics
