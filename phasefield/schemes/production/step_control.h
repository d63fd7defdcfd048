#pragma once

#include <cstddef>
#include <string>

#include "phasefield/layer/constants.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

/// Orders of BDF.
inline constexpr std::size_t highest_order = 3;
inline constexpr double largest_motion = constant("largest_motion");

/// Largest relative error of a step.
[[nodiscard]] double step_tolerance(const Parameters& parameters);
/// The same of the membrane's position [nm], over the circumference of what forms.
[[nodiscard]] double position_tolerance(const Parameters& parameters);

/// The first step [µs]: time.initial_step, or where that is 0 a part of first_step, for it is of order 1.
[[nodiscard]] double first_implicit_step(const Parameters& parameters);

/// What is known of a step that was tried.
struct TriedStep {
    double tau = 0;  // [µs]
    std::size_t order = 1;
    bool early = false;          // its error cannot be estimated well
    double wrong_position = 0;   // errors over those allowed, 0 where they are not known
    double wrong_molecules = 0;  // of ∫ c dA, where a bulk is depleted
    double motion = 0;           // of the layer, over the largest allowed
    double change = 0;           // of membrane and molecules, over the errors that a step may have
    bool hard = false;           // one factorisation did not serve
    bool finite = true;
};

/// Why the step must be repeated with a smaller one; empty when it may be kept.
[[nodiscard]] std::string rejection(const TriedStep& tried);

/// The step after one that was kept [µs]; `planned` is what that one would have been without a deadline, which does not
/// shorten the next one.
[[nodiscard]] double step_after(const TriedStep& tried, double planned, const Parameters& parameters);

/// The step to repeat it with [µs]. Throws SolverError("step-size-underflow", …) when smaller ones make no sense.
[[nodiscard]] double step_instead(const TriedStep& tried, double time, const Parameters& parameters);

}  // namespace endoflow::phasefield::production
