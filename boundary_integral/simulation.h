#pragma once

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

/// The boundary-integral engine's only entry for programs.
namespace endoflow::boundary_integral {

/// Name, libraries and own history columns of this engine.
[[nodiscard]] EngineIdentity identity(const Parameters& parameters);

/// Throws InputError when the engine does not offer what the parameters ask for.
void require_offered(const Parameters& parameters);

/// Runs a case from t = 0 or from the output's restart point to time.end, budding (output.stop_at_budding), neck
/// closure or interruption. Throws SolverError when it cannot go on, InputError when the engine does not offer what the
/// parameters ask for, IoError when the restart point does not fit them.
[[nodiscard]] ExitReason simulate(const Parameters& parameters, RunOutput& output);

}  // namespace endoflow::boundary_integral
