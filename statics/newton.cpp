#include "statics/newton.h"

#include <cmath>
#include <stdexcept>

namespace endoflow::statics {

namespace {

constexpr double converged = 1e-11;  // change in units of the scales
constexpr double stagnation = 1e-8;  // below this, changes that no longer shrink are round-off
constexpr double least_damping = 0.01;

struct DampedStep {
    PiecewiseSolution solution;
    double size;  // of the simplified Newton change after the step
    double damping;
};

/// The longest step along `change` after which the simplified Newton change is smaller than before.
std::optional<DampedStep> damped_step(const BoundaryValueProblem& problem, const GaussRule& rule,
                                      const LinearisedCollocation& linearised, const PiecewiseSolution& solution,
                                      const PiecewiseSolution& change, const BranchCondition& condition) {
    const double size = largest_entry(change, problem);
    for (double damping = 1; damping > least_damping; damping *= 0.5) {
        PiecewiseSolution trial = solution;
        trial.add(damping, change);
        const double next = largest_entry(linearised.solve(defect(problem, rule, trial, condition)), problem);
        const bool shrinks = next <= (1 - 0.25 * damping) * size;
        if (std::isfinite(next) && (shrinks || size < stagnation)) return DampedStep{std::move(trial), next, damping};
    }
    return std::nullopt;
}

}  // namespace

BranchCondition parameter_condition(const PiecewiseSolution& guess, double value, const BoundaryValueProblem& problem) {
    BranchCondition condition{guess, guess, 0};
    condition.normal.scale(0);
    condition.normal.parameter = problem.parameter_scale;
    condition.origin.parameter = value;
    return condition;
}

std::optional<NewtonResult> solve_newton(const BoundaryValueProblem& problem, const GaussRule& rule,
                                         const PiecewiseSolution& guess, const BranchCondition& condition,
                                         int most_iterations) {
    if (guess.slopes.front().cols() != rule.points)
        throw std::invalid_argument("solve_newton: the guess belongs to another collocation rule");
    NewtonResult result{guess, {}, 0, 0};
    for (; result.iterations < most_iterations; ++result.iterations) {
        const LinearisedCollocation linearised(problem, rule, result.solution, condition);
        if (!linearised.usable()) return std::nullopt;
        const PiecewiseSolution change = linearised.solve(defect(problem, rule, result.solution, condition));
        result.last_change = largest_entry(change, problem);
        if (!std::isfinite(result.last_change)) return std::nullopt;
        auto step = damped_step(problem, rule, linearised, result.solution, change, condition);
        if (!step) return std::nullopt;
        result.solution = std::move(step->solution);
        const bool round_off = result.last_change < stagnation && step->size > 0.1 * result.last_change;
        if (step->damping == 1 && (step->size < converged || round_off)) {
            // At the solution, not before the last change: the parameter's part of a tangent may be as small as that.
            const LinearisedCollocation here(problem, rule, result.solution, condition);
            if (!here.usable()) return std::nullopt;
            result.tangent = here.tangent();
            ++result.iterations;
            return result;
        }
    }
    return std::nullopt;
}

}  // namespace endoflow::statics
