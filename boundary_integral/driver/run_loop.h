#pragma once

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

/// Makes the time steps of a run from t = 0 or from the output's restart point, and lets the driver's other parts look
/// at each of them: rows of the history, events, shapes, fields, checkpoints. Says why the run ended.
/// Throws SolverError when it cannot go on, IoError when the restart point does not fit the parameters.
[[nodiscard]] ExitReason run_to_end(const Parameters& parameters, RunOutput& output);

}  // namespace endoflow::boundary_integral
