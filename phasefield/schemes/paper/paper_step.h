#pragma once

#include "phasefield/schemes/paper/discretization.h"

namespace endoflow::phasefield::paper {

/// One time step of Sec. 3 from tⁿ to tⁿ + τ: the coupled linear system for (u, p, λ, φ, g, f), whose nonlinear terms
/// are linearised once about level n; then s; then c. Leaves `old_state` alone; throws SolverError when a system cannot
/// be solved, whereupon the caller may try a smaller step.
State advance(Discretization& discretization, const State& old_state, double tau);

}  // namespace endoflow::phasefield::paper
