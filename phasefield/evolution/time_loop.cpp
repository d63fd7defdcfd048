#include "phasefield/evolution/time_loop.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "phasefield/evolution/clearance.h"
#include "phasefield/evolution/history.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::phasefield {

TimeLoop::TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator)
    : parameters_(parameters),
      output_(output),
      communicator_(communicator),
      scheme_(make_scheme(parameters, communicator)),
      model_(parameters.membrane) {
    if (output.restart_point())
        restart(*output.restart_point());
    else
        start_fresh();
}

void TimeLoop::start_fresh() {
    const StepOutcome outcome = scheme_->start();
    contour_ = outcome.contour;
    last_energy_ = outcome.diagnostics.bending_energy;
    record(0, outcome.diagnostics);
    write_shape();
    if (parameters_.output.field_interval > 0) write_fields();
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
        const double tau = scheme_->step(time_, next_deadline());
        if (const auto outcome = attempt(tau)) {
            keep(*outcome, tau);
            return;
        }
        output_.count_rejected_step();
        scheme_->reject(time_, tau);
    }
}

std::optional<StepOutcome> TimeLoop::attempt(double tau) {
    const PhaseTimer timer(output_, "time step");
    try {
        StepOutcome outcome = scheme_->attempt(time_, tau);
        if (outcome.rejection.empty()) return outcome;
        output_.log_info("step of " + std::to_string(1e3 * tau) + " ns rejected: " + outcome.rejection);
    } catch (const SolverError& error) {
        output_.log_info("step of " + std::to_string(1e3 * tau) + " ns rejected: " + error.what());
    }
    return {};
}

void TimeLoop::keep(const StepOutcome& outcome, double tau) {
    scheme_->keep(time_, tau, outcome);
    contour_ = outcome.contour;
    time_ += tau;
    record(tau, outcome.diagnostics);
    watch_neck(tau);
    const PhaseTimer timer(output_, "mesh adaptation");
    scheme_->follow(contour_.curve);
}

void TimeLoop::record(double tau, const StepDiagnostics& diagnostics) {
    const PhaseTimer timer(output_, "observables");
    observables_ = measure(contour_.curve, model_);
    const double dissipation =
        diagnostics.viscous_dissipation + diagnostics.mobility_dissipation + diagnostics.extension_dissipation;
    const double residual = tau > 0 ? (diagnostics.bending_energy - last_energy_) / tau + dissipation : 0;
    last_energy_ = diagnostics.bending_energy;
    output_.record_step(make_history_row({time_, tau, diagnostics, scheme_->integrate(), observables_, residual,
                                          scheme_->unknowns(), scheme_->cells()}));
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
    if (interval > 0 && (end || reached(static_cast<double>(field_times_.size()) * interval))) write_fields();
}

void TimeLoop::write_fields() {
    const PhaseTimer timer(output_, "field output");
    scheme_->write_fields(output_.directory(), field_times_, time_);
}

bool TimeLoop::anywhere(bool here) const {
    return dealii::Utilities::MPI::max(here ? 1 : 0, communicator_) == 1;
}

}  // namespace endoflow::phasefield
