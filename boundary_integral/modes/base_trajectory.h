#pragma once

// The axisymmetric motion as a function of time: integrated by the engine from the start of its case, each step's
// polynomial kept.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "boundary_integral/evolution/membrane_dynamics.h"

namespace endoflow::boundary_integral {

struct TrajectoryRequest {
    Eigen::VectorXd start;   ///< state vector at time 0
    double end = 0.0;        ///< µs
    double tolerance = 0.0;  ///< error of a step that counts as one: nm in the curve, 1 in the concentration
};

class BaseTrajectory {
  public:
    /// Throws the SolverError of an integration that fails.
    BaseTrajectory(const MembraneDynamics& dynamics, const Parameters& parameters, const TrajectoryRequest& request);

    /// The state vector at a time in [0, end], to the integrator's order.
    [[nodiscard]] Eigen::VectorXd state(double time) const;
    [[nodiscard]] double end() const { return end_; }
    /// When the neck's radius falls below `budding_neck_radius`, µs.
    [[nodiscard]] std::optional<double> budding() const { return budding_; }
    [[nodiscard]] std::size_t steps() const { return steps_.size(); }

  private:
    /// States at the nodes of a step; the polynomial through them is the integrator's own.
    struct Step {
        double end;
        std::vector<double> times;
        Eigen::MatrixXd states;  // column by column
    };
    double end_;
    std::vector<Step> steps_;
    std::optional<double> budding_;
};

}  // namespace endoflow::boundary_integral
