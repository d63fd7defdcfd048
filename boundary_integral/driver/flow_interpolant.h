#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "boundary_integral/evolution/membrane_dynamics.h"

namespace endoflow::boundary_integral {

/// The flow at times inside the last step, by a polynomial through the flows of the last steps: each of them was
/// computed with its step's own operators, and new operators for every shape would cost more than the steps.
/// Coefficients belong to the same material up to the mesh's motion, which is as smooth in time as the flow.
class FlowInterpolant {
  public:
    /// Forgets what was before: the flow at a time where the integrator starts anew.
    void start(double time, const Evaluation& evaluation);
    /// The flow at the end of a step; times increase.
    void add(double time, const Evaluation& evaluation);

    /// Velocity, force and tension at a time between the last two, or at the only one; the rest is empty.
    [[nodiscard]] FlowSolution at(double time) const;
    /// What goes with them on the walls of the box, as WallPanels numbers it.
    [[nodiscard]] Eigen::VectorXd wall_unknowns(double time, const BoxFlow& box) const;

  private:
    struct Knot {
        double time;  // µs
        FlowSolution flow;
        std::shared_ptr<const MobilityOperators> operators;
    };
    std::deque<Knot> knots_;

    [[nodiscard]] std::vector<double> weights(double time) const;  // Lagrange's, of the knots
};

}  // namespace endoflow::boundary_integral
