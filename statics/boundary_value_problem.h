#pragma once

#include <Eigen/Core>
#include <functional>

namespace endoflow::statics {

/// dy/dx at one point, (n), with its derivatives by the n states and by the g global unknowns.
struct SlopeValues {
    Eigen::VectorXd value;
    Eigen::MatrixXd by_state;   // (n, n)
    Eigen::MatrixXd by_global;  // (n, g)
};

/// The n + g boundary conditions, zero when they hold, with their derivatives.
struct ConditionValues {
    Eigen::VectorXd value;
    Eigen::MatrixXd by_first;   // by the states at x = 0, (n + g, n)
    Eigen::MatrixXd by_last;    // by the states at x = 1, (n + g, n)
    Eigen::MatrixXd by_global;  // (n + g, g)
};

/// dy/dx = slope(x, y, globals) on 0 < x < 1 and conditions(y(0), y(1), globals) = 0.
/// The slope is never asked for at x = 0 or 1, so it may be singular there if the solution is smooth.
struct Equations {
    std::function<SlopeValues(double x, const Eigen::VectorXd& y, const Eigen::VectorXd& globals)> slope;
    std::function<ConditionValues(const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                                  const Eigen::VectorXd& globals)>
        conditions;
};

/// A family of boundary-value problems with one parameter. The scales say what counts as a change of order one in
/// each unknown; they set the meaning of "small" in Newton's method and of length along a branch.
struct BoundaryValueProblem {
    std::function<Equations(double parameter)> at;
    Eigen::VectorXd state_scales;   // (n)
    Eigen::VectorXd global_scales;  // (g)
    double parameter_scale = 1;

    [[nodiscard]] Eigen::Index states() const { return state_scales.size(); }
    [[nodiscard]] Eigen::Index globals() const { return global_scales.size(); }
};

}  // namespace endoflow::statics
