#pragma once

#include "phasefield/evolution/discretization.h"

namespace endoflow::phasefield {

/// One time step of the chosen scheme from tⁿ to tⁿ + τ. Leaves `old_state` alone; throws SolverError when a system
/// cannot be solved, whereupon the caller may try a smaller step.
State advance(Discretization& discretization, const State& old_state, double tau);

}  // namespace endoflow::phasefield
