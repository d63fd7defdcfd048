#pragma once

#include <memory>
#include <optional>

#include "phasefield/driver/molecule_balance.h"
#include "phasefield/schemes/interface/scheme.h"
#include "shared/geometry/observables.h"
#include "shared/model/bending_model.h"
#include "shared/output/neck_events.h"
#include "shared/output/output_plan.h"
#include "shared/output/run_output.h"

namespace endoflow::phasefield {

/// A run in progress: the scheme with its state, the clock and what must be remembered between steps.
class TimeLoop {
  public:
    TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator, std::unique_ptr<Scheme> scheme);
    ExitReason run();

  private:
    void start_fresh();
    void restart(const Checkpoint& checkpoint);
    /// Steps until there is a reason to stop. Throws Interrupted within a step, which then was not made.
    ExitReason step_to_an_end();
    void step();
    /// The outcome of a trial step that may be kept; empty when it must be repeated with a smaller one.
    std::optional<StepOutcome> attempt(double tau);
    /// Where a step must end so that the neck is then as narrow as a waiting collar is wide; empty when it does not get
    /// beyond.
    [[nodiscard]] std::optional<double> collar_due(const StepOutcome& outcome, double tau) const;
    void place_collar();
    void keep(const StepOutcome& outcome, double tau);
    /// The mesh follows the membrane, once the last step's output is written.
    void follow();
    void record(double tau, const StepDiagnostics& diagnostics);
    void note_solver() const;
    void watch_neck(double tau);
    void record(const NeckEvent& event);
    /// At a time within the last step [nm].
    [[nodiscard]] double neck_radius_at(double time) const;
    /// 0 where the membrane has come apart, infinite without a neck [nm].
    [[nodiscard]] double neck_radius_of(const Contour& contour, double time) const;
    /// ε over the neck's radius; 0 without a neck.
    [[nodiscard]] double layer_at_neck() const;
    void check_clearance() const;
    void write_due_output();
    /// The membrane at a time within the last step.
    [[nodiscard]] MembraneCurve curve_at(double time) const;
    void write_shape(double time);
    void write_fields(double time);
    void checkpoint();
    /// Of the coat at a time.
    [[nodiscard]] BendingModel model(double time) const { return bending_model(parameters_, time); }
    [[nodiscard]] bool anywhere(bool here) const;
    [[nodiscard]] std::optional<ExitReason> reason_to_stop();

    Parameters parameters_;
    RunOutput& output_;
    MPI_Comm communicator_;
    std::unique_ptr<Scheme> scheme_;
    Contour contour_;
    Observables observables_{};
    double time_ = 0, last_energy_ = 0, last_loss_ = 0;  // E + E_c and what it loses per time
    MoleculeBalance molecules_;
    OutputPlan plan_;
    double checkpoints_written_ = 0;
    std::vector<double> field_times_;
    NeckEvents events_;
    double neck_radius_ = 0;               // at the end of the last step, nm
    std::optional<ExitReason> event_end_;  // of an event that ends the run
};

}  // namespace endoflow::phasefield
