#include "boundary_integral/modes/step_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double smallest_factor = 0.2, largest_factor = 4.0, safety = 0.9;

}  // namespace

StepControl::Step StepControl::next(double time, double end) const {
    const double left = end - time;
    if (length_ > 0.99 * left) return {time, left, end, true};
    const double length = std::min(length_, 0.5 * left);
    return {time, length, time + length, false};
}

bool StepControl::accepts(const Step& step, double error) {
    const double factor =
        error >= 0.0 ? std::clamp(safety * std::pow(error, -1.0 / (order_ + 1)), smallest_factor, largest_factor)
                     : smallest_factor;
    const bool accepted = error <= 1.0;
    if (!accepted)
        length_ = step.length * std::min(factor, safety);
    else if (step.last && factor > 1.0)  // a step that was cut to meet a time says little about the next one
        length_ = std::max(length_, step.length * factor);
    else
        length_ = step.length * factor;
    if (length_ < smallest_step) {
        throw SolverError(
            "modes-step-underflow",
            fmt::format("the step of the perturbations fell to {:.2g} µs at t = {:.6g} µs", length_, step.begin),
            "use more elements in the run");
    }
    return accepted;
}

}  // namespace endoflow::boundary_integral
