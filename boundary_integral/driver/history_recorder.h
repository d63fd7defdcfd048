#pragma once

#include <string>
#include <vector>

#include "boundary_integral/driver/molecule_balance.h"
#include "boundary_integral/evolution/material_strain.h"
#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/output/history_columns.h"
#include "shared/output/run_output.h"

namespace endoflow::boundary_integral {

/// What this engine checks at a step beyond what all engines record.
struct StepBalances {
    EnergyBalance energy;
    double power_floor;  // what the energy's balance is relative to at rest, pN nm/µs
    FlowBalances flow;
    double inflow;                        // of membrane at the rim, nm/µs
    std::optional<double> wall_distance;  // nm, none without walls
    int order;                            // of the integrator
    double line_energy;                   // E_c, pN nm
    double exchanged, molecule_balance;
    double maturity;          // χ
    double resolution_error;  // estimated, of neck radius and budding time, relative
};

/// This engine's own columns of history.csv.
[[nodiscard]] const std::vector<OwnColumn<StepBalances>>& own_history_columns();

/// Rows of history.csv: what is measured on the membrane at the end of a step or at an event.
class HistoryRecorder {
  public:
    HistoryRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output);

    /// The first rates of the markers and the first mass of molecules, when no checkpoint is restored.
    void start(const Evaluation& evaluation);

    /// Adds a row at a time inside the integrator's last step. At the step's end `evaluation` holds the flow that made
    /// it. Throws SolverError when the membrane is in a state that the model does not hold for.
    void record(double time, const Evaluation& evaluation, const StiffIntegrator& integrator);

    /// Elements were added at a time [µs]: what interpolating to them left relaxes at first.
    void settle(double since);

    /// Time of the last row, µs.
    [[nodiscard]] double last_row() const { return last_row_; }

    /// energy_balance_relative of the last row; 0 while what interpolating left relaxes, and after restore().
    [[nodiscard]] double last_energy_balance() const { return energy_balance_; }

    void save(Checkpoint& checkpoint) const;
    void restore(const Checkpoint& checkpoint);

  private:
    const Parameters& parameters_;
    const MembraneDynamics& dynamics_;
    RunOutput& output_;
    RestLevel rest_;
    MaterialStrain strain_;
    MoleculeBalance molecules_;
    MaterialRates strain_rates_;  // at the last row
    double last_row_ = 0.0;       // µs
    double largest_power_ = 0.0;  // so far, pN nm/µs
    double energy_balance_ = 0.0;
    double settled_from_ = 0.0;  // µs

    [[nodiscard]] double resolution_error(const MembraneState& state) const;
};

}  // namespace endoflow::boundary_integral
