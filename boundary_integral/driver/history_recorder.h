#pragma once

#include <string>
#include <vector>

#include "boundary_integral/evolution/material_strain.h"
#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/evolution/observation.h"
#include "shared/output/run_output.h"

namespace endoflow::boundary_integral {

/// Names of this engine's own columns of history.csv, in the order of the recorder's values.
[[nodiscard]] std::vector<std::string> own_history_columns();

/// Rows of history.csv: what is measured on the membrane at the end of a step or at an event.
class HistoryRecorder {
  public:
    HistoryRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output);

    /// The first rates of the markers, when no checkpoint is restored.
    void start(const Evaluation& evaluation) { strain_rates_ = strain_.rates(evaluation); }

    /// Adds a row. After a step `evaluation` holds the flow that made it; `order` is the integrator's.
    /// Throws SolverError when the membrane is in a state that the model does not hold for.
    void record(double time, const Evaluation& evaluation, int order);

    /// Time of the last row, µs.
    [[nodiscard]] double last_row() const { return last_row_; }

    void save(Checkpoint& checkpoint) const;
    void restore(const Checkpoint& checkpoint);

  private:
    const Parameters& parameters_;
    const MembraneDynamics& dynamics_;
    RunOutput& output_;
    MaterialStrain strain_;
    MaterialRates strain_rates_;  // at the last row
    double last_row_ = 0.0;       // µs

    [[nodiscard]] std::vector<double> own_values(const Evaluation& evaluation, const ShapeIntegrals& shape,
                                                 int order) const;
};

}  // namespace endoflow::boundary_integral
