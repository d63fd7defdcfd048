#pragma once

#include <deque>

#include "boundary_integral/flow/flow_model.h"

namespace endoflow::boundary_integral {

/// The flow at times inside the last step, by a polynomial through the flows of the last steps: each of them was
/// computed with its step's own operators, and new operators for every shape would cost more than the steps.
/// Coefficients belong to the same material up to the mesh's motion, which is as smooth in time as the flow.
class FlowInterpolant {
  public:
    /// Forgets what was before: the flow at a time where the integrator starts anew.
    void start(double time, const FlowSolution& flow);
    /// The flow at the end of a step; times increase.
    void add(double time, const FlowSolution& flow);

    /// Velocity and tension at a time between the last two, or at the only one; the rest is empty.
    [[nodiscard]] FlowSolution at(double time) const;

  private:
    struct Knot {
        double time;  // µs
        Eigen::VectorXd velocity, tension;
    };
    std::deque<Knot> knots_;
};

}  // namespace endoflow::boundary_integral
