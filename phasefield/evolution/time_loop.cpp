#include "phasefield/evolution/time_loop.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "phasefield/evolution/clearance.h"
#include "phasefield/evolution/scheme.h"
#include "phasefield/io/field_output.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::phasefield {

namespace {

/// The mesh follows when the membrane may have moved this far since it was made; in units of ε.
constexpr double adapt_after_motion = 0.4;

}  // namespace

TimeLoop::TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator)
    : parameters_(parameters),
      output_(output),
      communicator_(communicator),
      discretization_(parameters, communicator),
      control_(parameters),
      model_(parameters.membrane) {
    if (output.restart_point())
        restart(*output.restart_point());
    else
        start_fresh();
}

void TimeLoop::start_fresh() {
    state_ = initial_state(discretization_);
    contour_ = extract_contour(discretization_.spaces, state_, parameters_);
    const auto diagnostics = diagnose_step(discretization_.spaces, state_.flow, state_, parameters_);
    last_energy_ = diagnostics.bending_energy;
    record(0, diagnostics);
    write_shape();
    if (parameters_.output.field_interval > 0)
        write_fields(output_.directory(), field_times_, time_, discretization_.spaces, state_);
}

ExitReason TimeLoop::run() {
    while (true) {
        if (const auto reason = reason_to_stop()) {
            if (time_ > 0) checkpoint();
            return *reason;
        }
        step();
        check_clearance();
        write_due_output();
        if (anywhere(output_.checkpoint_due())) checkpoint();
    }
}

std::optional<ExitReason> TimeLoop::reason_to_stop() {
    if (time_ >= parameters_.time.end * (1 - 1e-12)) return ExitReason::done;
    if (anywhere(interruption_signal() != 0)) return ExitReason::interrupted;
    if (budding_time_ && parameters_.output.stop_at_budding) return ExitReason::budded;
    if (contour_.components > 1) return ExitReason::neck_closed;
    return {};
}

void TimeLoop::step() {
    while (true) {
        const double tau = control_.step(time_, next_deadline());
        if (auto trial = attempt(tau)) {
            keep(std::move(*trial), tau);
            return;
        }
        output_.count_rejected_step();
        discretization_.coupled.forget_factors();
        control_.reject(time_);
    }
}

std::optional<TimeLoop::Trial> TimeLoop::attempt(double tau) {
    const Spaces& spaces = discretization_.spaces;
    try {
        State state = [&] {
            const PhaseTimer timer(output_, "time step");
            return advance(discretization_, state_, tau);
        }();
        const PhaseTimer timer(output_, "observables");
        const auto diagnostics = diagnose_step(spaces, state_.flow, state, parameters_);
        if (control_.too_far(diagnostics.motion_max) || !std::isfinite(diagnostics.bending_energy)) {
            output_.log_info("step of " + std::to_string(1e3 * tau) + " ns rejected: motion " +
                             std::to_string(diagnostics.motion_max) + " nm");
            return {};
        }
        Contour contour = extract_contour(spaces, state, parameters_);
        return Trial{std::move(state), diagnostics, std::move(contour)};
    } catch (const SolverError& error) {
        output_.log_info(std::string("step rejected: ") + error.what());
        return {};
    }
}

void TimeLoop::keep(Trial trial, double tau) {
    state_ = std::move(trial.state);
    contour_ = std::move(trial.contour);
    time_ += tau;
    control_.accept(tau, trial.diagnostics.motion_max);
    record(tau, trial.diagnostics);
    watch_neck(tau);
    moved_ += trial.diagnostics.motion_max;
    adapt_when_moved();
}

void TimeLoop::adapt_when_moved() {
    if (moved_ < adapt_after_motion * parameters_.phase_field.epsilon) return;
    const PhaseTimer timer(output_, "mesh adaptation");
    adapt(discretization_, state_, positions(contour_.curve));
    moved_ = 0;
}

void TimeLoop::record(double tau, const StepDiagnostics& diagnostics) {
    const auto integrals = integrate_layer(discretization_.spaces, state_, parameters_);
    observables_ = measure(contour_.curve, model_);
    const double dissipation =
        diagnostics.viscous_dissipation + diagnostics.mobility_dissipation + diagnostics.extension_dissipation;
    const double residual = tau > 0 ? (diagnostics.bending_energy - last_energy_) / tau + dissipation : 0;
    last_energy_ = diagnostics.bending_energy;
    output_.record_step(make_history_row({time_, tau, diagnostics, integrals, observables_, residual,
                                          static_cast<double>(discretization_.spaces.flow.dofs.n_dofs()),
                                          static_cast<double>(discretization_.mesh->n_global_active_cells())}));
}

void TimeLoop::watch_neck(double tau) {
    const auto before = neck_radius_;
    neck_radius_ = observables_.neck ? std::optional(observables_.neck->radius) : std::nullopt;
    if (budding_time_ || !neck_radius_ || *neck_radius_ >= budding_neck_radius) return;
    const double part = before ? (*before - budding_neck_radius) / (*before - *neck_radius_) : 1;
    budding_time_ = time_ - (1 - part) * tau;
    output_.record_event("budding", *budding_time_,
                         {{"bud_diameter_nm", observables_.neck->lateral_diameter},
                          {"membrane_area_nm2", observables_.membrane_area},
                          {"bud_height_nm", observables_.bud_height}});
}

void TimeLoop::check_clearance() const {
    require_clearance(contour_.curve, parameters_, time_);
}

double TimeLoop::next_deadline() const {
    double deadline = std::min(parameters_.time.end, shapes_written_ * parameters_.output.shape_interval);
    if (parameters_.output.field_interval > 0)
        deadline = std::min(deadline, static_cast<double>(field_times_.size()) * parameters_.output.field_interval);
    return deadline;
}

void TimeLoop::write_shape() {
    output_.write_shape(time_, contour_.curve);
    shapes_written_ += 1;
}

void TimeLoop::write_due_output() {
    const auto reached = [this](double time) { return time_ >= time * (1 - 1e-12); };
    const bool end = reached(parameters_.time.end);
    if (end || reached(shapes_written_ * parameters_.output.shape_interval)) write_shape();
    const double interval = parameters_.output.field_interval;
    if (interval > 0 && (end || reached(static_cast<double>(field_times_.size()) * interval))) {
        const PhaseTimer timer(output_, "field output");
        write_fields(output_.directory(), field_times_, time_, discretization_.spaces, state_);
    }
}

bool TimeLoop::anywhere(bool here) const {
    return dealii::Utilities::MPI::max(here ? 1 : 0, communicator_) == 1;
}

}  // namespace endoflow::phasefield
