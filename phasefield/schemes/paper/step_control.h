#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::paper {

/// Chooses the time steps of scheme `paper`: the printed ramp (doubling every ramp_steps accepted steps up to a limit),
/// unless step_rule is `ramp` held back so that the membrane moves less than max_motion per step.
class StepControl {
  public:
    explicit StepControl(const Parameters& parameters);

    /// The step to take now; it ends at `deadline` when that is near. [µs]
    [[nodiscard]] double step(double time, double deadline) const;
    /// After an accepted step of length tau in which the membrane moved by `motion` [nm].
    void accept(double tau, double motion);
    /// After a rejected one. Throws SolverError("step-size-underflow", …), under step_rule `ramp` at once
    /// SolverError("printed-scheme-failed", …).
    void reject(double time);
    /// Not-a-number counts as too far.
    [[nodiscard]] bool too_far(double motion) const { return !(motion <= max_motion_); }

    // State that a checkpoint must keep.
    double nominal;  // µs
    double since_doubling = 0;

  private:
    double initial_, limit_, max_motion_;  // max_motion_ is infinite without a guard
    int ramp_steps_;
    StepRule rule_;
};

}  // namespace endoflow::phasefield::paper
