#pragma once

#include "phasefield/schemes/interface/diagnostics.h"
#include "phasefield/schemes/paper/coupled_step.h"

namespace endoflow::phasefield::paper {

/// Collective.
LayerIntegrals integrate_layer(const Spaces& spaces, const State& state, const Parameters& parameters);

/// From `before` to `state` in τ [µs]; 0: `before` is the present state. Collective.
StepDiagnostics diagnose_step(const Spaces& spaces, const State& before, const State& state, double tau,
                              const Parameters& parameters);

}  // namespace endoflow::phasefield::paper
