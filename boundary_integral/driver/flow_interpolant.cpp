#include "boundary_integral/driver/flow_interpolant.h"

#include "shared/numerics/lagrange.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t most_knots = 4;  // cubic: below the integrator's order, above what shows in a picture

}  // namespace

void FlowInterpolant::start(double time, const Evaluation& evaluation) {
    knots_.clear();
    add(time, evaluation);
}

void FlowInterpolant::add(double time, const Evaluation& evaluation) {
    if (knots_.size() == most_knots) knots_.pop_front();
    knots_.push_back({time, evaluation.flow, evaluation.operators});
}

std::vector<double> FlowInterpolant::weights(double time) const {
    std::vector<double> times;
    for (const Knot& knot : knots_) times.push_back(knot.time);
    return lagrange_weights(times, time);
}

FlowSolution FlowInterpolant::at(double time) const {
    const std::vector<double> weight = weights(time);
    const FlowSolution& last = knots_.back().flow;
    FlowSolution flow;
    flow.velocity = Eigen::VectorXd::Zero(last.velocity.size());
    flow.force = Eigen::VectorXd::Zero(last.force.size());
    flow.multipliers.tension = Eigen::VectorXd::Zero(last.multipliers.tension.size());
    for (std::size_t k = 0; k < knots_.size(); ++k) {
        flow.velocity += weight[k] * knots_[k].flow.velocity;
        flow.force += weight[k] * knots_[k].flow.force;
        flow.multipliers.tension += weight[k] * knots_[k].flow.multipliers.tension;
    }
    return flow;
}

Eigen::VectorXd FlowInterpolant::wall_unknowns(double time, const BoxFlow& box) const {
    const std::vector<double> weight = weights(time);
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(box.walls().unknowns());
    for (std::size_t k = 0; k < knots_.size(); ++k)
        unknowns += weight[k] * box.wall_unknowns(*knots_[k].operators, knots_[k].flow);
    return unknowns;
}

}  // namespace endoflow::boundary_integral
