#include "boundary_integral/driver/flow_interpolant.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t most_knots = 4;  // cubic: below the integrator's order, above what shows in a picture

}  // namespace

void FlowInterpolant::start(double time, const FlowSolution& flow) {
    knots_.clear();
    add(time, flow);
}

void FlowInterpolant::add(double time, const FlowSolution& flow) {
    if (knots_.size() == most_knots) knots_.pop_front();
    knots_.push_back({time, flow.velocity, flow.multipliers.tension});
}

FlowSolution FlowInterpolant::at(double time) const {
    FlowSolution flow;
    flow.velocity = Eigen::VectorXd::Zero(knots_.back().velocity.size());
    flow.multipliers.tension = Eigen::VectorXd::Zero(knots_.back().tension.size());
    for (const Knot& knot : knots_) {
        double weight = 1.0;  // Lagrange's
        for (const Knot& other : knots_) {
            if (&other != &knot) weight *= (time - other.time) / (knot.time - other.time);
        }
        flow.velocity += weight * knot.velocity;
        flow.multipliers.tension += weight * knot.tension;
    }
    return flow;
}

}  // namespace endoflow::boundary_integral
