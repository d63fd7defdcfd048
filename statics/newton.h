#pragma once

#include <optional>

#include "statics/linearised_collocation.h"

namespace endoflow::statics {

struct NewtonResult {
    PiecewiseSolution solution;
    PiecewiseSolution tangent;  // of the branch, along the condition's normal
    int iterations = 0;
    double last_change = 0;  // of the last step, in units of the scales
};

/// The condition parameter = value, for solving at a given parameter.
[[nodiscard]] BranchCondition parameter_condition(const PiecewiseSolution& guess, double value,
                                                  const BoundaryValueProblem& problem);

/// Newton's method, damped by the natural monotonicity test (P. Deuflhard, Newton Methods for Nonlinear Problems,
/// Springer 2004, Sec. 3.3), until the changes fall below 1e-11 of the scales or stop falling below 1e-8.
/// Empty when it does not converge.
[[nodiscard]] std::optional<NewtonResult> solve_newton(const BoundaryValueProblem& problem, const GaussRule& rule,
                                                       const PiecewiseSolution& guess, const BranchCondition& condition,
                                                       int most_iterations);

}  // namespace endoflow::statics
