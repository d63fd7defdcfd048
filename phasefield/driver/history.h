#pragma once

#include <string>
#include <vector>

#include "phasefield/schemes/interface/diagnostics.h"
#include "shared/geometry/observables.h"
#include "shared/output/history_file.h"

namespace endoflow::phasefield {

/// The engine's own columns of history.csv, in the order of make_history_row.
std::vector<std::string> extra_history_columns();

/// What a step left behind, for history.csv.
struct StepRecord {
    double time, tau;  // µs
    StepDiagnostics diagnostics;
    LayerIntegrals integrals;
    Observables observables;
    double energy_law_residual;  // dE/dt + dissipation − transport's power [pN nm/µs], (21)
    double unknowns, cells;
};

HistoryRow make_history_row(const StepRecord& record);

}  // namespace endoflow::phasefield
