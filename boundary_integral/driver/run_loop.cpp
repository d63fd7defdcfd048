#include "boundary_integral/driver/run_loop.h"

#include <memory>

#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/integrator_checkpoint.h"
#include "boundary_integral/driver/neck_events.h"
#include "boundary_integral/driver/output_series.h"
#include "shared/model/time_scale.h"
#include "shared/support/interruption.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double smallest_step = 1e-14;  // µs

// Where steps are as long as a slowly growing coat lets them, a membrane that relaxes in less than a nanosecond must be
// at rest: what the iteration leaves of it is a velocity, 10⁵ times as large per time as over the step.
StepLimits step_limits(const Parameters& parameters) {
    StepLimits limits{longest_step(parameters), smallest_step};
    if (parameters.molecules.exchange != Exchange::none) limits.iteration = 1e-5;
    return limits;
}

class RunLoop {
  public:
    RunLoop(const Parameters& parameters, RunOutput& output)
        : parameters_(parameters),
          output_(output),
          dynamics_(parameters),
          history_(parameters, dynamics_, output),
          events_(parameters, dynamics_, output),
          series_(parameters, dynamics_, flow_, output),
          start_(start()),
          integrator_(problem(), start_, step_limits(parameters)) {}

    ExitReason execute() {
        if (!output_.restart_point()) begin();
        begin_section();
        ExitReason reason = ExitReason::interrupted;
        try {
            reason = advance_to_an_end();
        } catch (const Interrupted&) {
            output_.log_info("a step was given up");
        }
        return stop(reason);
    }

  private:
    ExitReason advance_to_an_end() {
        while (integrator_.time() < parameters_.time.end) {
            if (integrator_.statistics().steps == next_start_) start_anew();
            if (interruption_signal() != 0) return ExitReason::interrupted;
            if (output_.checkpoint_due()) output_.write_checkpoint(resume_);
            advance();
            const Evaluation accepted = dynamics_.evaluate(integrator_.state(), operators_);
            flow_.add(integrator_.time(), accepted);
            if (const auto reason = events_.look(integrator_, history_, series_)) return *reason;
            series_.write_until(integrator_.time(), integrator_);
            history_.record(integrator_.time(), accepted, integrator_);
        }
        series_.write_shape_at(integrator_.time(), integrator_);
        return ExitReason::done;
    }

    const Parameters& parameters_;
    RunOutput& output_;
    MembraneDynamics dynamics_;
    FlowInterpolant flow_;
    HistoryRecorder history_;
    NeckEvents events_;
    OutputSeries series_;
    std::shared_ptr<const MobilityOperators> operators_;  // of the step's predicted shape
    Eigen::VectorXd predicted_;                           // what that shape belongs to
    Evaluation latest_;                                   // of the last rate the integrator asked for
    StartingPoint start_;                                 // of the integrator
    StiffIntegrator integrator_;
    Checkpoint resume_;  // of the integrator's starting point
    long next_start_ = parameters_.boundary_integral.restart_interval;
    long rejected_ = 0;

    // A checkpoint is always of a point where the integrator starts anew: a restart then makes the steps that a run
    // without interruption makes, whenever it was interrupted, and whatever its end was.
    [[nodiscard]] Checkpoint make_checkpoint() const {
        Checkpoint checkpoint;
        save(start_, checkpoint);
        history_.save(checkpoint);
        events_.save(checkpoint);
        series_.save(checkpoint);
        return checkpoint;
    }

    void begin() {
        make_operators(start_.y);
        const Evaluation initial = dynamics_.evaluate(start_.y, operators_);
        history_.start(initial);
        series_.write_initial(initial);
    }

    void begin_section() {
        make_operators(start_.y);
        flow_.start(start_.time, dynamics_.evaluate(start_.y, operators_));
        resume_ = make_checkpoint();
    }

    void start_anew() {
        start_ = integrator_.start_anew();
        next_start_ += parameters_.boundary_integral.restart_interval;
        begin_section();
    }

    StartingPoint start() {
        if (const auto& checkpoint = output_.restart_point()) {
            history_.restore(*checkpoint);
            events_.restore(*checkpoint);
            series_.restore(*checkpoint);
            return restored_start(*checkpoint, dynamics_.size(), output_.directory().string());
        }
        return {0.0, first_step(parameters_), dynamics_.initial_vector()};
    }

    void make_operators(const Eigen::VectorXd& predicted) {
        if (operators_ && predicted == predicted_) return;
        const PhaseTimer timer(output_, "flow operators");
        operators_ = dynamics_.operators(predicted);
        predicted_ = predicted;
    }

    StiffProblem problem() {
        StiffProblem problem;
        problem.begin_step = [this](const Eigen::VectorXd& predicted) {
            give_up_if_interrupted();
            make_operators(predicted);
        };
        problem.rate = [this](const Eigen::VectorXd& y) {
            give_up_if_interrupted();
            const PhaseTimer timer(output_, "rates");
            latest_ = dynamics_.evaluate(y, operators_);
            return latest_.rate;
        };
        problem.jacobian = [this] {
            const PhaseTimer timer(output_, "Jacobians");
            return dynamics_.jacobian(latest_);
        };
        // One unit of error: time.tolerance nm in the curve, time.tolerance in the concentration.
        problem.error_scales =
            dynamics_.error_scales(dynamics_.initial_vector(), parameters_.time.tolerance, parameters_.time.tolerance);
        return problem;
    }

    void advance() {
        integrator_.advance(parameters_.time.end);
        const auto& statistics = integrator_.statistics();
        const long rejected = statistics.error_test_failures + statistics.convergence_failures;
        for (; rejected_ < rejected; ++rejected_) output_.count_rejected_step();
    }

    /// What the run leaves behind, however far it got within a step.
    ExitReason stop(ExitReason reason) {
        output_.write_checkpoint(resume_);
        const auto& statistics = integrator_.statistics();
        output_.note("integrator", {{"steps", statistics.steps},
                                    {"operators", statistics.steps_begun},
                                    {"rate_evaluations", statistics.rates},
                                    {"jacobians", statistics.jacobians},
                                    {"error_test_failures", statistics.error_test_failures},
                                    {"convergence_failures", statistics.convergence_failures},
                                    {"steps_of_order", statistics.steps_of_order}});
        output_.note("unknowns", dynamics_.size());
        if (const BoxFlow* box = dynamics_.box()) output_.note("wall_unknowns", box->walls().unknowns());
        return reason;
    }
};

}  // namespace

ExitReason run_to_end(const Parameters& parameters, RunOutput& output) {
    return RunLoop(parameters, output).execute();
}

}  // namespace endoflow::boundary_integral
