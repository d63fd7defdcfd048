#pragma once

// Lengths of the steps of a linear propagation, from their embedded error estimates.

namespace endoflow::boundary_integral {

class StepControl {
  public:
    /// `first_step` in µs; an estimate of order q falls as the step to the power q + 1.
    StepControl(double first_step, int estimate_order) : length_(first_step), order_(estimate_order) {}

    struct Step {
        double begin, length, end;  // µs; `end` is exact where it was asked for
        bool last;                  // meets the end that was asked for
    };
    [[nodiscard]] Step next(double time, double end) const;

    /// Whether a step with this error, relative to what is allowed, counts; what is no number does not. Throws
    /// SolverError("modes-step-underflow").
    [[nodiscard]] bool accepts(const Step& step, double error);

  private:
    double length_;
    int order_;
};

}  // namespace endoflow::boundary_integral
