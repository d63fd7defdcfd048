#pragma once

#include <Eigen/Core>
#include <functional>

namespace endoflow::boundary_integral {

/// y' = F(y), stiff. F and ∂F/∂y of one attempted step may use what was computed for its predicted state: what depends
/// smoothly on y needs one evaluation for each step then, not one for each iteration. The prediction is as accurate as
/// the step, so the order is kept.
/// A SolverError in these functions costs a smaller step; any other exception ends the integration.
struct StiffProblem {
    std::function<void(const Eigen::VectorXd& predicted)> begin_step;
    std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> rate;  ///< F(y), per µs
    std::function<Eigen::MatrixXd()> jacobian;  ///< ∂F/∂y at the state of the last call of `rate`
    Eigen::VectorXd error_scales;               ///< absolute error that counts as one, by component
};

}  // namespace endoflow::boundary_integral
