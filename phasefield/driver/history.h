#pragma once

#include <vector>

#include "phasefield/driver/molecule_balance.h"
#include "phasefield/schemes/interface/diagnostics.h"
#include "shared/output/history_columns.h"

namespace endoflow::phasefield {

/// What a step left behind, for history.csv.
struct StepRecord {
    double time, tau;  // µs
    StepDiagnostics diagnostics;
    LayerIntegrals integrals;
    Observables observables;
    double maturity;             // χ
    double energy_law_residual;  // d(E + E_c)/dt + dissipation − power of transport and loads [pN nm/µs], (21)
    MoleculeBalance molecules;
    double unknowns, cells;
    double layer_at_neck;  // ε over the neck's radius; 0 without a neck
};

/// The engine's own columns of history.csv.
[[nodiscard]] const std::vector<OwnColumn<StepRecord>>& own_history_columns();

[[nodiscard]] HistoryRow make_history_row(const StepRecord& record);

}  // namespace endoflow::phasefield
