#include "boundary_integral/statics/continuation.h"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace endoflow::statics {

namespace {

constexpr int corrector_iterations = 8;
constexpr int easy_iterations = 3;

/// The point of the branch at this distance along the tangent of `from`.
std::optional<BranchPoint> point_ahead(const BoundaryValueProblem& problem, const GaussRule& rule,
                                       const BranchPoint& from, double distance, int& iterations) {
    PiecewiseSolution guess = from.solution;
    guess.add(distance, from.tangent);
    auto corrected = solve_newton(problem, rule, guess, BranchCondition{from.tangent, from.solution, distance},
                                  corrector_iterations);
    if (!corrected) return std::nullopt;
    iterations = corrected->iterations;
    return BranchPoint{std::move(corrected->solution), std::move(corrected->tangent), from.arc_length + distance,
                       from.folds_before};
}

/// The same point on a mesh that fits it.
std::optional<BranchPoint> adapted(const BoundaryValueProblem& problem, const GaussRule& rule,
                                   const BranchPoint& point) {
    const auto mesh = equidistributed_mesh(point.solution, rule, problem.state_scales, point.solution.elements());
    const BranchPoint moved{interpolate(point.solution, rule, mesh), interpolate(point.tangent, rule, mesh),
                            point.arc_length, point.folds_before};
    int iterations = 0;
    return point_ahead(problem, rule, moved, 0, iterations);
}

/// The fold between `from` and the point at `distance`, where the parameter's part of the tangent changes its sign.
std::optional<Fold> locate_fold(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& from,
                                double distance, double tangent_there) {
    std::optional<BranchPoint> nearest;
    int iterations = 0;
    const auto tangent_at = [&](double length) {
        nearest = point_ahead(problem, rule, from, length, iterations);
        if (!nearest) throw std::domain_error("the corrector failed next to a fold");
        return nearest->tangent.parameter;
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
    return Fold{*nearest};
}

/// The point with parameter = target between two neighbours, guessed along the first one's tangent.
std::optional<BranchPoint> point_at(const BoundaryValueProblem& problem, const GaussRule& rule,
                                    const BranchPoint& before, double distance, double target) {
    // With regula falsi along the branch first, so that Newton starts near also when a fold is close.
    BranchPoint nearest = before;
    double lower = 0, upper = distance;
    const double sign = before.solution.parameter < target ? 1 : -1;
    for (int i = 0; i < 6; ++i) {
        int iterations = 0;
        const double middle = 0.5 * (lower + upper);
        auto point = point_ahead(problem, rule, before, middle, iterations);
        if (!point) return std::nullopt;
        (sign * (point->solution.parameter - target) < 0 ? lower : upper) = middle;
        nearest = std::move(*point);
    }
    auto solved = solve_newton(problem, rule, nearest.solution, parameter_condition(nearest.solution, target, problem),
                               2 * corrector_iterations);
    if (!solved) return std::nullopt;
    if (inner_product(solved->tangent, nearest.tangent, problem) < 0) {
        PiecewiseSolution reversed = solved->tangent;
        solved->tangent.add(-2, reversed);
    }
    return BranchPoint{std::move(solved->solution), std::move(solved->tangent), nearest.arc_length,
                       nearest.folds_before};
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
    auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, guess.parameter, problem), 50);
    if (!solved) return std::nullopt;
    BranchPoint point{std::move(solved->solution), std::move(solved->tangent), 0, 0};
    if (point.tangent.parameter * (target - guess.parameter) < 0) {
        const PiecewiseSolution reversed = point.tangent;
        point.tangent.add(-2, reversed);
    }
    return adapted(problem, rule, point);
}

Branch follow_branch(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& start,
                     double target, const ContinuationSettings& settings, const Admissible& admissible,
                     const Visitor& visit) {
    Branch branch{start, {}, BranchEnd::too_long};
    const double begin = start.solution.parameter, sign = target > begin ? 1 : -1;
    double step = settings.first_step;
    if (!visit(start)) {
        branch.end = BranchEnd::stopped;
        return branch;
    }
    for (int count = 1; count < settings.most_points;) {
        if (step < settings.shortest_step) {
            branch.end = BranchEnd::no_progress;
            return branch;
        }
        int iterations = 0;
        auto next = point_ahead(problem, rule, branch.last, step, iterations);
        if (!next || !admissible(next->solution) ||
            inner_product(next->tangent, branch.last.tangent, problem) < settings.least_cosine) {
            step *= 0.5;
            continue;
        }
        const bool arrives = sign * (next->solution.parameter - target) >= 0;
        if (arrives) {
            auto at_target = point_at(problem, rule, branch.last, step, target);
            if (!at_target) {
                step *= 0.5;
                continue;
            }
            branch.last = std::move(*at_target);
            branch.end = BranchEnd::reached_target;
            visit(branch.last);
            return branch;
        }
        if (next->tangent.parameter * branch.last.tangent.parameter < 0) {
            if (auto fold = locate_fold(problem, rule, branch.last, step, next->tangent.parameter))
                branch.folds.push_back(std::move(*fold));
            ++next->folds_before;
        }
        auto settled = adapted(problem, rule, *next);
        branch.last = settled ? std::move(*settled) : std::move(*next);
        ++count;
        if (!visit(branch.last)) {
            branch.end = BranchEnd::stopped;
            return branch;
        }
        if (sign * (branch.last.solution.parameter - begin) < 0) {
            branch.end = BranchEnd::returned;
            return branch;
        }
        if (iterations <= easy_iterations) step = std::min(1.5 * step, settings.longest_step);
    }
    return branch;
}

}  // namespace endoflow::statics
