#include "boundary_integral/driver/run_loop.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "boundary_integral/driver/event_recorder.h"
#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/output_series.h"
#include "boundary_integral/evolution/refinement.h"
#include "shared/case/resolution.h"
#include "shared/model/time_scale.h"
#include "shared/output/accuracy.h"
#include "shared/output/phase_timer.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::boundary_integral {

namespace {

using IntegratorStatistics = StiffIntegrator::Statistics;

/// Steps are as long as their error allows. A membrane that relaxes in less than a nanosecond must be at rest where a
/// slowly growing coat lets steps be much longer: what the iteration leaves is a velocity, 10⁵ times as large per time
/// as over the step.
StepLimits step_limits(const Parameters& parameters) {
    StepLimits limits;
    if (parameters.time.max_step > 0) limits.largest = parameters.time.max_step;
    if (parameters.molecules.exchange != Exchange::none) limits.iteration = 1e-5;
    return limits;
}

/// The case with what its accuracy chooses.
Parameters with_resolution(Parameters parameters, Index elements) {
    parameters.time.tolerance = sharp_tolerance(parameters);
    parameters.boundary_integral.elements = static_cast<int>(elements);
    return parameters;
}

Index elements_at(const std::optional<Checkpoint>& from, const Parameters& parameters) {
    return from ? static_cast<Index>(from->scalar("elements")) : initial_elements(parameters);
}

/// The point that a resumed integration starts from, in a checkpoint.
void save(const StartingPoint& start, Checkpoint& checkpoint) {
    checkpoint.time_us = start.time;
    checkpoint.scalars["first_step"] = start.step;
    checkpoint.arrays["unknowns"] = {start.y.data(), start.y.data() + start.y.size()};
}

/// Throws IoError when the checkpoint, which lies in `directory`, does not hold `size` unknowns.
StartingPoint restored_start(const Checkpoint& checkpoint, Eigen::Index size, const std::string& directory) {
    const std::vector<double>& unknowns = checkpoint.array("unknowns");
    if (static_cast<Eigen::Index>(unknowns.size()) != size)
        throw IoError("the checkpoint in " + directory + " does not hold this membrane; run without --restart");
    return {checkpoint.time_us, checkpoint.scalar("first_step"),
            Eigen::Map<const Eigen::VectorXd>(unknowns.data(), size)};
}

}  // namespace

/// A run from its beginning or a checkpoint on, as long as its elements are enough.
class RunLoop {
  public:
    RunLoop(const Parameters& parameters, const std::optional<Checkpoint>& from, const IntegratorStatistics& before,
            RunOutput& output)
        : parameters_(with_resolution(parameters, elements_at(from, parameters))),
          may_refine_(parameters.boundary_integral.elements == 0),
          before_(before),
          output_(output),
          from_(from),
          dynamics_(parameters_),
          history_(parameters_, dynamics_, output),
          events_(parameters_, dynamics_, output),
          series_(parameters_, dynamics_, flow_, from_ ? std::optional(from_->time_us) : std::nullopt, output),
          start_(start()),
          integrator_(problem(), start_, step_limits(parameters_)) {}

    /// What comes before the first step.
    void open() {
        if (!from_) begin();
        begin_section();
    }

    /// One step; why the run ended, when it did.
    std::optional<ExitReason> step() {
        std::optional<ExitReason> reason = ExitReason::interrupted;
        try {
            reason = step_or_end();
        } catch (const Interrupted&) {
            output_.log_info("a step was given up");
        }
        if (reason) stop();
        return reason;
    }

    // What the state and the flow that led to it say decides, so that a continued run adds elements where the
    // uninterrupted one does: it starts where they were enough.
    bool needs_more_elements() {
        if (!may_refine_ || at_end()) return false;
        const Index now = dynamics_.space().elements();
        more_elements_ =
            elements_for(dynamics_.space(), dynamics_.unpack(integrator_.state()), accuracy_of_elements(parameters_),
                         history_.last_energy_balance(), balance_bound_);
        return more_elements_ > now;
    }

    /// The same point of the run on more elements.
    Checkpoint refined() {
        const StartingPoint here = integrator_.start_anew();
        const auto finer = dynamics_with(parameters_, more_elements_);
        start_ = {here.time, here.step, transferred(dynamics_, here.y, *finer)};
        refinements_.push_back(here.time);
        elements_.push_back(static_cast<double>(more_elements_));
        output_.log_info(fmt::format("{} elements from t = {:.6g} µs on", more_elements_, here.time));
        return make_checkpoint();
    }

    [[nodiscard]] MembraneCurve shape() const { return series_.curve_at(integrator_.time(), integrator_); }

    [[nodiscard]] IntegratorStatistics statistics() const {
        IntegratorStatistics all = integrator_.statistics();
        return all += before_;
    }

  private:
    [[nodiscard]] bool at_end() const { return integrator_.time() >= parameters_.time.end; }

    std::optional<ExitReason> step_or_end() {
        if (!at_end()) {
            if (integrator_.statistics().steps == next_start_) start_anew();
            if (output_.stop_requested()) return ExitReason::interrupted;
            if (output_.checkpoint_due()) output_.write_checkpoint(resume_);
            advance();
            const std::optional<double> collar = events_.collar_due(integrator_);
            const double end = collar.value_or(integrator_.time());
            const Evaluation accepted = dynamics_.evaluate(end, integrator_.state_at(end), operators_);
            flow_.add(end, accepted);
            if (const auto reason = events_.look(end, integrator_, history_, series_)) return *reason;
            series_.write_until(end, integrator_);
            history_.record(end, accepted, integrator_);
            if (collar) place_collar(end, accepted.state);
        }
        if (!at_end()) return std::nullopt;
        series_.write_shape_at(integrator_.time(), integrator_);
        return ExitReason::done;
    }

    void give_up_if_asked() const {
        if (output_.stop_requested()) throw Interrupted();
    }

    Parameters parameters_;  // resolved
    bool may_refine_;
    double balance_bound_ = sharp_bound("energy-balance", parameters_).bound;
    IntegratorStatistics before_;
    RunOutput& output_;
    std::optional<Checkpoint> from_;
    MembraneDynamics dynamics_;
    FlowInterpolant flow_;
    HistoryRecorder history_;
    EventRecorder events_;
    OutputSeries series_;
    std::vector<double> refinements_, elements_;          // since when [µs] there are how many, the beginning first
    std::shared_ptr<const MobilityOperators> operators_;  // of the step's predicted shape
    Eigen::VectorXd predicted_;                           // what that shape belongs to
    Evaluation latest_;                                   // of the last rate the integrator asked for
    StartingPoint start_;                                 // of the integrator
    StiffIntegrator integrator_;
    Checkpoint resume_;  // of the integrator's starting point
    Index more_elements_ = 0;
    long next_start_ = parameters_.boundary_integral.restart_interval;
    long rejected_ = 0;

    /// A checkpoint is always of a point where the integrator starts anew: a restart then makes the steps that a run
    /// without interruption makes, whenever it was interrupted, and whatever its end was.
    [[nodiscard]] Checkpoint make_checkpoint() const {
        Checkpoint checkpoint;
        save(start_, checkpoint);
        checkpoint.scalars["elements"] = elements_.back();
        checkpoint.arrays["refinement_times"] = refinements_;
        checkpoint.arrays["refinement_elements"] = elements_;
        if (dynamics_.loads().radial()) checkpoint.scalars["collar_place"] = dynamics_.loads().collar_place;
        history_.save(checkpoint);
        events_.save(checkpoint);
        return checkpoint;
    }

    void begin() {
        make_operators(start_.y);
        const Evaluation initial = dynamics_.evaluate(start_.time, start_.y, operators_);
        history_.start(initial);
        series_.write_initial(initial);
    }

    void begin_section() {
        make_operators(start_.y);
        flow_.start(start_.time, dynamics_.evaluate(start_.time, start_.y, operators_));
        resume_ = make_checkpoint();
    }

    void start_anew() {
        start_ = integrator_.start_anew();
        next_start_ += parameters_.boundary_integral.restart_interval;
        begin_section();
    }

    /// What is left of the last step is made anew, with the collar.
    void place_collar(double time, const MembraneState& state) {
        series_.write_shape_at(time, integrator_);
        const double area = area_within(dynamics_.space(), state, find_neck(dynamics_.space(), state)->t);
        dynamics_.place_collar(area);
        output_.record_event("collar", time, measure_shape(dynamics_.space(), state, parameters_.domain));
        output_.log_info(
            fmt::format("the collar sits at a material radius of {:.6g} nm", std::sqrt(area / std::numbers::pi)));
        start_ = integrator_.start_anew_at(time, first_step(parameters_));
        next_start_ = integrator_.statistics().steps + parameters_.boundary_integral.restart_interval;
        begin_section();
    }

    StartingPoint start() {
        if (from_) {
            history_.restore(*from_);
            events_.restore(*from_);
            if (from_->scalars.contains("collar_place")) dynamics_.place_collar(from_->scalar("collar_place"));
            refinements_ = from_->array("refinement_times");
            elements_ = from_->array("refinement_elements");
            if (refinements_.size() > 1) history_.settle(refinements_.back());
            return restored_start(*from_, dynamics_.size(), output_.directory().string());
        }
        refinements_ = {0.0};
        elements_ = {static_cast<double>(dynamics_.space().elements())};
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
            give_up_if_asked();
            make_operators(predicted);
        };
        problem.rate = [this](double time, const Eigen::VectorXd& y) {
            give_up_if_asked();
            const PhaseTimer timer(output_, "rates");
            latest_ = dynamics_.evaluate(time, y, operators_);
            return latest_.rate;
        };
        problem.jacobian = [this] {
            const PhaseTimer timer(output_, "Jacobians");
            return dynamics_.jacobian(latest_);
        };
        // One unit of error: time.tolerance nm in the curve, time.tolerance in the concentration.
        problem.error_scales =
            dynamics_.error_scales(dynamics_.initial_vector(), parameters_.time.tolerance, parameters_.time.tolerance);
        problem.allowed_part = [this](double time) { return early_part(time, parameters_); };
        return problem;
    }

    void advance() {
        integrator_.advance(parameters_.time.end);
        const auto& statistics = integrator_.statistics();
        const long rejected = statistics.error_test_failures + statistics.convergence_failures;
        for (; rejected_ < rejected; ++rejected_) output_.count_rejected_step();
    }

    /// What the run leaves behind, however far it got within a step.
    void stop() {
        output_.write_checkpoint(resume_);
        const IntegratorStatistics statistics = this->statistics();
        output_.note("integrator", {{"steps", statistics.steps},
                                    {"operators", statistics.steps_begun},
                                    {"rate_evaluations", statistics.rates},
                                    {"jacobians", statistics.jacobians},
                                    {"error_test_failures", statistics.error_test_failures},
                                    {"convergence_failures", statistics.convergence_failures},
                                    {"steps_of_order", statistics.steps_of_order}});
        output_.note("time_tolerance", parameters_.time.tolerance);
        output_.note("elements", dynamics_.space().elements());
        auto refinements = RunRecord::array();
        for (std::size_t i = 0; i < elements_.size(); ++i)
            refinements.push_back({{"time_us", refinements_[i]}, {"elements", std::lround(elements_[i])}});
        output_.note("elements_from", refinements);
        output_.note("unknowns", dynamics_.size());
        if (const BoxFlow* box = dynamics_.box()) output_.note("wall_unknowns", box->walls().unknowns());
    }
};

class Run::Implementation {
  public:
    Implementation(const Parameters& parameters, RunOutput& output) : parameters_(parameters), output_(output) {
        open(output.restart_point(), {});
    }

    std::optional<ExitReason> step() {
        if (loop_->needs_more_elements()) {
            const Checkpoint here = loop_->refined();
            open(here, loop_->statistics());
        }
        return loop_->step();
    }

    [[nodiscard]] MembraneCurve shape() const { return loop_->shape(); }

  private:
    Parameters parameters_;
    RunOutput& output_;
    std::unique_ptr<RunLoop> loop_;

    void open(const std::optional<Checkpoint>& from, const IntegratorStatistics& before) {
        loop_.reset();
        loop_ = std::make_unique<RunLoop>(parameters_, from, before, output_);
        loop_->open();
    }
};

Run::Run(const Parameters& parameters, RunOutput& output)
    : implementation_(std::make_unique<Implementation>(parameters, output)) {}

Run::~Run() = default;

std::optional<ExitReason> Run::step() {
    return implementation_->step();
}

MembraneCurve Run::shape() const {
    return implementation_->shape();
}

}  // namespace endoflow::boundary_integral
