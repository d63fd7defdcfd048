// The flow between steps.

#include <catch2/catch.hpp>

#include "boundary_integral/driver/flow_interpolant.h"

namespace {

using namespace endoflow::boundary_integral;

FlowSolution flow_at(double time) {
    FlowSolution flow;
    flow.velocity = Eigen::Vector2d(1 + time * time * time, 2 * time);
    flow.force = Eigen::VectorXd::Constant(1, time * time * time);
    flow.multipliers.tension = Eigen::VectorXd::Constant(1, time * time);
    return flow;
}

Evaluation evaluation_at(double time) {
    Evaluation evaluation;
    evaluation.flow = flow_at(time);
    return evaluation;
}

}  // namespace

TEST_CASE("a flow that is cubic in time is interpolated exactly, whatever the steps", "[flow]") {
    FlowInterpolant interpolant;
    interpolant.start(0.0, evaluation_at(0.0));
    CHECK(interpolant.at(0.0).velocity == flow_at(0.0).velocity);
    interpolant.add(0.1, evaluation_at(0.1));
    // Two flows: linear.
    CHECK(interpolant.at(0.05).multipliers.tension[0] == Approx(0.005));
    for (const double time : {0.15, 0.4, 0.5, 0.9}) interpolant.add(time, evaluation_at(time));
    for (const double time : {0.5, 0.6, 0.75, 0.9}) {
        const FlowSolution flow = interpolant.at(time), exact = flow_at(time);
        CHECK((flow.velocity - exact.velocity).norm() < 1e-13);
        CHECK(flow.force[0] == Approx(exact.force[0]).epsilon(1e-13));
        CHECK(flow.multipliers.tension[0] == Approx(exact.multipliers.tension[0]).epsilon(1e-13));
    }
    interpolant.start(1.0, evaluation_at(1.0));
    CHECK(interpolant.at(1.0).velocity == flow_at(1.0).velocity);  // what was before is forgotten
}
