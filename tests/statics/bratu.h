#pragma once

#include <cmath>

#include "statics/boundary_value_problem.h"

/// Bratu's problem y'' + p e^y = 0, y(0) = y(1) = 0: solutions in closed form and a fold at p = 3.513830719125…
inline endoflow::statics::BoundaryValueProblem bratu_problem() {
    using namespace endoflow::statics;
    BoundaryValueProblem problem;
    problem.state_scales = Eigen::Vector2d(1, 1);
    problem.at = [](double p) -> Equations {
        const auto slope = [p](double, const Eigen::VectorXd& y, const Eigen::VectorXd&) {
            SlopeValues result{Eigen::Vector2d(y(1), -p * std::exp(y(0))), Eigen::Matrix2d::Zero(),
                               Eigen::MatrixXd(2, 0)};
            result.by_state(0, 1) = 1;
            result.by_state(1, 0) = -p * std::exp(y(0));
            return result;
        };
        const auto conditions = [](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd&) {
            ConditionValues result{Eigen::Vector2d(first(0), last(0)), Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                   Eigen::MatrixXd(2, 0)};
            result.by_first(0, 0) = 1;
            result.by_last(1, 0) = 1;
            return result;
        };
        return {slope, conditions};
    };
    return problem;
}

/// y(1/2) of the lower solution for p below the fold: 2 ln cosh(θ/4) with θ = √(2p) cosh(θ/4), by iteration, which
/// is slow next to the fold.
inline double bratu_maximum(double p) {
    double theta = 0;
    for (int i = 0; i < 20000; ++i) theta = std::sqrt(2 * p) * std::cosh(theta / 4);
    return 2 * std::log(std::cosh(theta / 4));
}
