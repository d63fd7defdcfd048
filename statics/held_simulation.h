#pragma once

#include "statics/simulation.h"

namespace endoflow::statics {

/// simulate() for a case whose neck is held. Throws SolverError where the necks asked for have no shapes.
[[nodiscard]] ExitReason simulate_hold(const Parameters& parameters, const Request& request, RunOutput& output);

}  // namespace endoflow::statics
