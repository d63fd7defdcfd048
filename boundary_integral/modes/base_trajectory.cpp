#include "boundary_integral/modes/base_trajectory.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/geometry/observables.h"
#include "shared/model/time_scale.h"
#include "shared/numerics/level_crossing.h"

namespace endoflow::boundary_integral {

BaseTrajectory::BaseTrajectory(const MembraneDynamics& dynamics, const Parameters& parameters,
                               const TrajectoryRequest& request)
    : end_(request.end) {
    std::shared_ptr<const MobilityOperators> operators;
    Evaluation latest;
    StiffProblem problem;
    problem.begin_step = [&](const Eigen::VectorXd& predicted) { operators = dynamics.operators(predicted); };
    problem.rate = [&](double time, const Eigen::VectorXd& y) {
        latest = dynamics.evaluate(time, y, operators);
        return latest.rate;
    };
    problem.jacobian = [&] { return dynamics.jacobian(latest); };
    problem.error_scales = dynamics.error_scales(request.start, request.tolerance, request.tolerance);
    operators = dynamics.operators(request.start);
    StepLimits limits;
    if (parameters.time.max_step > 0) limits.largest = parameters.time.max_step;
    StiffIntegrator integrator(problem, {0.0, first_step(parameters), request.start}, limits);
    const auto radius_at = [&](double time) {
        return neck_radius(find_neck(dynamics.space(), dynamics.unpack(integrator.state_at(time))));
    };
    while (integrator.time() < end_) {
        integrator.advance(end_);
        const int order = integrator.last_order();
        Step step{integrator.time(), {}, Eigen::MatrixXd(request.start.size(), order + 1)};
        for (int i = 0; i <= order; ++i) {
            const double fraction = 0.5 * (1.0 + std::cos(std::numbers::pi * i / order));  // from the end back
            step.times.push_back(integrator.time() - fraction * integrator.last_step());
            step.states.col(i) = integrator.state_at(step.times.back());
        }
        steps_.push_back(std::move(step));
        const double end = integrator.time();
        if (!budding_) budding_ = falls_below(radius_at, end - integrator.last_step(), end, budding_neck_radius);
    }
}

Eigen::VectorXd BaseTrajectory::state(double time) const {
    auto step = std::ranges::lower_bound(steps_, time, {}, &Step::end);
    if (step == steps_.end()) --step;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(step->states.rows());
    for (std::size_t i = 0; i < step->times.size(); ++i) {
        double weight = 1.0;
        for (std::size_t j = 0; j < step->times.size(); ++j) {
            if (j != i) weight *= (time - step->times[j]) / (step->times[i] - step->times[j]);
        }
        sum += weight * step->states.col(static_cast<Index>(i));
    }
    return sum;
}

}  // namespace endoflow::boundary_integral
