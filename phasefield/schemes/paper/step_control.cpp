#include "phasefield/schemes/paper/step_control.h"

#include <algorithm>
#include <limits>
#include <string>

#include "shared/model/time_scale.h"
#include "shared/support/error.h"

namespace endoflow::phasefield::paper {

namespace {

constexpr double safety = 0.8;
constexpr double worthwhile_growth = 1.2;   // a new step length costs a factorisation
constexpr double smallest_fraction = 1e-4;  // of the first step

constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace

StepControl::StepControl(const Parameters& p)
    : nominal(first_step(p)),
      initial_(first_step(p)),
      limit_(std::min(p.phase_field.paper.max_step, longest_step(p))),
      max_motion_(p.phase_field.paper.step_rule == StepRule::ramp ? no_limit : p.phase_field.paper.max_motion),
      ramp_steps_(p.phase_field.paper.ramp_steps),
      rule_(p.phase_field.paper.step_rule) {}

double StepControl::step(double time, double deadline) const {
    const double left = deadline - time;
    if (nominal >= left * (1 - 1e-9)) return left;
    return nominal >= 0.5 * left ? 0.5 * left : nominal;  // no tiny last step
}

void StepControl::accept(double tau, double motion) {
    since_doubling += 1;
    const double allowed = motion > 0 ? tau * safety * max_motion_ / motion : no_limit;
    if (since_doubling >= ramp_steps_ && worthwhile_growth * nominal <= allowed) {
        nominal = std::min(2 * nominal, allowed);
        since_doubling = 0;
    }
    nominal = std::min({nominal, limit_, allowed});
}

void StepControl::reject(double time) {
    if (rule_ == StepRule::ramp)
        throw SolverError("printed-scheme-failed",
                          "the step of " + std::to_string(1e3 * nominal) + " ns at t = " + std::to_string(time) +
                              " µs has no usable solution (log.txt says why), and step_rule = \"ramp\" takes no other",
                          "set phase_field.paper.step_rule = \"guarded\", or a smaller max_step");
    nominal *= 0.5;
    since_doubling = 0;
    if (nominal < smallest_fraction * initial_)
        throw SolverError("step-size-underflow", "no acceptable time step at t = " + std::to_string(time) + " µs",
                          "use a smaller phase_field.cell_size, or a larger max_motion or tension_extension in "
                          "[phase_field.paper]");
}

}  // namespace endoflow::phasefield::paper
