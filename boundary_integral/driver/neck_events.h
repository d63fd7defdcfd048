#pragma once

#include <functional>
#include <optional>

#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/output_series.h"
#include "boundary_integral/integration/stiff_integrator.h"

namespace endoflow::boundary_integral {

/// The events of a run: "budding" when the neck falls below budding_neck_radius, "neck_closed" when it falls below
/// boundary_integral.neck_closed_radius.
class NeckEvents {
  public:
    NeckEvents(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output);

    /// Records the events inside the integrator's last step, each with a row of the history and a shape. Says when one
    /// ends the run.
    [[nodiscard]] std::optional<ExitReason> look(const StiffIntegrator& integrator, HistoryRecorder& history,
                                                 OutputSeries& series);

    void save(Checkpoint& checkpoint) const { checkpoint.scalars["budded"] = budded_ ? 1.0 : 0.0; }
    void restore(const Checkpoint& checkpoint) { budded_ = checkpoint.scalar("budded") != 0.0; }

  private:
    const Parameters& parameters_;
    const MembraneDynamics& dynamics_;
    RunOutput& output_;
    bool budded_ = false;

    void record(const char* name, double time, const StiffIntegrator& integrator, HistoryRecorder& history,
                OutputSeries& series);
};

}  // namespace endoflow::boundary_integral
