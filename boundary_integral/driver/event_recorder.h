#pragma once

#include <functional>
#include <optional>

#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/output_series.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/output/neck_events.h"

namespace endoflow::boundary_integral {

/// The events of a run, each with a row of the history and a shape. The neck is closed when it is narrower than
/// boundary_integral.neck_closed_radius.
class EventRecorder {
  public:
    EventRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output);

    /// When the neck that a collar waits for came inside the integrator's last step.
    [[nodiscard]] std::optional<double> collar_due(const StiffIntegrator& integrator) const;

    /// Records the events inside the integrator's last step up to `end`. Says when one ends the run.
    [[nodiscard]] std::optional<ExitReason> look(double end, const StiffIntegrator& integrator,
                                                 HistoryRecorder& history, OutputSeries& series);

    void save(Checkpoint& checkpoint) const { checkpoint.scalars["budded"] = events_.budded() ? 1.0 : 0.0; }
    void restore(const Checkpoint& checkpoint) { events_.restore(checkpoint.scalar("budded") != 0.0); }

  private:
    const MembraneDynamics& dynamics_;
    RunOutput& output_;
    DomainParameters domain_;
    NeckEvents events_;

    [[nodiscard]] std::function<double(double time)> neck_in(const StiffIntegrator& integrator) const;

    void record(const NeckEvent& event, const StiffIntegrator& integrator, HistoryRecorder& history,
                OutputSeries& series);
};

}  // namespace endoflow::boundary_integral
