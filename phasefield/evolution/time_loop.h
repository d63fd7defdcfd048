#pragma once

#include <optional>

#include "phasefield/evolution/discretization.h"
#include "phasefield/evolution/history.h"
#include "phasefield/evolution/step_control.h"
#include "shared/output/run_output.h"

namespace endoflow::phasefield {

/// A run in progress: the state, the clocks and what must be remembered between steps.
class TimeLoop {
  public:
    TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator);
    ExitReason run();

  private:
    void start_fresh();
    void restart(const Checkpoint& checkpoint);
    void step();
    /// A trial step that is kept; empty when it was rejected.
    struct Trial {
        State state;
        StepDiagnostics diagnostics;
        Contour contour;
    };
    std::optional<Trial> attempt(double tau);
    void keep(Trial trial, double tau);
    void adapt_when_moved();
    void record(double tau, const StepDiagnostics& diagnostics);
    void watch_neck(double tau);
    void check_clearance() const;
    void write_due_output();
    void write_shape();
    void checkpoint();
    [[nodiscard]] double next_deadline() const;
    [[nodiscard]] bool anywhere(bool here) const;
    [[nodiscard]] std::optional<ExitReason> reason_to_stop();

    Parameters parameters_;
    RunOutput& output_;
    MPI_Comm communicator_;
    Discretization discretization_;
    StepControl control_;
    BendingModel model_;
    State state_;
    Contour contour_;
    Observables observables_{};
    double time_ = 0, last_energy_ = 0, moved_ = 0;
    double shapes_written_ = 0, checkpoints_written_ = 0;
    std::vector<double> field_times_;
    std::optional<double> neck_radius_, budding_time_;
};

}  // namespace endoflow::phasefield
