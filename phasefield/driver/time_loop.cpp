#include "phasefield/driver/time_loop.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "phasefield/driver/clearance.h"
#include "phasefield/driver/history.h"
#include "phasefield/fem/interruption.h"
#include "shared/model/membrane_energy.h"
#include "shared/output/output_times.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

constexpr int event_iterations = 4;  // of regula falsi within a step

}  // namespace

TimeLoop::TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator,
                   std::unique_ptr<Scheme> scheme)
    : parameters_(parameters),
      output_(output),
      communicator_(communicator),
      scheme_(std::move(scheme)),
      model_(parameters.membrane) {
    if (output.restart_point())
        restart(*output.restart_point());
    else
        start_fresh();
}

void TimeLoop::start_fresh() {
    const StepOutcome outcome = scheme_->start();
    contour_ = outcome.contour;
    last_energy_ = outcome.diagnostics.bending_energy + outcome.diagnostics.line_energy;
    molecules_.start(scheme_->integrate().molecules, outcome.diagnostics.exchange_rate);
    record(0, outcome.diagnostics);
    output_.write_shape(0, contour_.curve);
    if (parameters_.output.field_interval > 0) write_fields(0);
    plan_output(0);
}

ExitReason TimeLoop::run() {
    ExitReason reason = ExitReason::interrupted;
    try {
        reason = step_to_an_end();
    } catch (const Interrupted&) {
        output_.log_info("the step after t = " + std::to_string(time_) + " µs was given up");
    }
    if (reason != ExitReason::interrupted) write_shape(time_, contour_.curve);
    checkpoint();
    return reason;
}

ExitReason TimeLoop::step_to_an_end() {
    while (true) {
        if (const auto reason = reason_to_stop()) return *reason;
        step();
        check_clearance();
        write_due_output();
        follow();
        if (anywhere(output_.checkpoint_due())) checkpoint();
    }
}

std::optional<ExitReason> TimeLoop::reason_to_stop() {
    if (time_ >= parameters_.time.end * (1 - same_time)) return ExitReason::done;
    if (interrupted(communicator_)) return ExitReason::interrupted;
    if (budding_time_ && parameters_.output.stop_at_budding) return ExitReason::budded;
    if (contour_.components > 1) return ExitReason::neck_closed;
    return {};
}

void TimeLoop::step() {
    while (true) {
        const double tau = scheme_->step(time_, parameters_.time.end);
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
}

void TimeLoop::follow() {
    const PhaseTimer timer(output_, "mesh adaptation");
    scheme_->follow(contour_.curve);
}

void TimeLoop::record(double tau, const StepDiagnostics& diagnostics) {
    const PhaseTimer timer(output_, "observables");
    observables_ = measure(contour_.curve, model_);
    if (tau > 0) molecules_.advance(time_, diagnostics.exchange_rate);
    const double molecular = energetically_coupled(parameters_.molecules)
                                 ? diagnostics.exchange_power - diagnostics.molecule_dissipation
                                 : diagnostics.transport_power;
    const double loss = diagnostics.viscous_dissipation + diagnostics.mobility_dissipation + diagnostics.tension_power -
                        molecular - diagnostics.load_power;
    // (21) over the step, the power by the trapezoidal rule; the first step starts from rest in an instant.
    const double power = last_loss_ != 0 ? 0.5 * (last_loss_ + loss) : loss;
    const double energy = diagnostics.bending_energy + diagnostics.line_energy;
    const double residual = tau > 0 ? (energy - last_energy_) / tau + power : 0;
    last_energy_ = energy;
    last_loss_ = loss;
    output_.record_step(make_history_row({time_, tau, diagnostics, scheme_->integrate(), observables_, residual,
                                          molecules_, scheme_->unknowns(), scheme_->cells()}));
}

void TimeLoop::watch_neck(double tau) {
    const auto before = neck_radius_;
    neck_radius_ = observables_.neck ? std::optional(observables_.neck->radius) : std::nullopt;
    if (budding_time_ || !neck_radius_ || *neck_radius_ >= budding_neck_radius) return;
    Observables at_event = observables_;
    budding_time_ = before ? time_of_budding(*before, tau, at_event) : time_;
    output_.record_event("budding", *budding_time_,
                         {{"neck_radius_nm", at_event.neck->radius},
                          {"bud_diameter_nm", at_event.neck->lateral_diameter},
                          {"membrane_area_nm2", at_event.membrane_area},
                          {"bud_height_nm", at_event.bud_height}});
    write_shapes_before(*budding_time_);
    write_shape(*budding_time_, scheme_->contour_at(*budding_time_).curve);
}

double TimeLoop::time_of_budding(double before, double tau, Observables& at_event) const {
    double low = time_ - tau, above = before, high = time_, below = *neck_radius_;
    const auto crossing = [&] { return low + (high - low) * (above - budding_neck_radius) / (above - below); };
    for (int k = 0; k < event_iterations; ++k) {
        const double time = crossing();
        const Observables middle = measure(scheme_->contour_at(time).curve, model_);
        if (!middle.neck) break;
        at_event = middle;
        const double radius = middle.neck->radius;
        (radius < budding_neck_radius ? high : low) = time;
        (radius < budding_neck_radius ? below : above) = radius;
    }
    return crossing();
}

void TimeLoop::check_clearance() const {
    require_clearance(contour_.curve, parameters_, time_);
}

void TimeLoop::plan_output(double time) {
    next_shape_ = next_shape_time(parameters_.output.shape_interval, time);
    next_fields_ = next_multiple(parameters_.output.field_interval, time);
}

void TimeLoop::write_shapes_before(double time) {
    for (; next_shape_ < time * (1 - same_time);
         next_shape_ = next_shape_time(parameters_.output.shape_interval, next_shape_))
        write_shape(next_shape_, scheme_->contour_at(next_shape_).curve);
}

void TimeLoop::write_shape(double time, const MembraneCurve& curve) {
    if (time > 0 && time <= last_shape_ * (1 + same_time)) return;
    output_.write_shape(time, curve);
    last_shape_ = time;
}

void TimeLoop::write_due_output() {
    const auto now = [this](double time) { return std::abs(time - time_) <= same_time * time_; };
    write_shapes_before(time_);
    for (; next_fields_ < time_ && !now(next_fields_);
         next_fields_ = next_multiple(parameters_.output.field_interval, next_fields_))
        write_fields(next_fields_);
    const bool end = time_ >= parameters_.time.end * (1 - same_time);
    if (end || now(next_shape_)) write_shape(time_, contour_.curve);
    if ((end && parameters_.output.field_interval > 0) || now(next_fields_)) write_fields(time_);
    plan_output(time_);
}

void TimeLoop::write_fields(double time) {
    const PhaseTimer timer(output_, "field output");
    scheme_->write_fields(output_.directory(), field_times_, time);
}

bool TimeLoop::anywhere(bool here) const {
    return dealii::Utilities::MPI::max(here ? 1 : 0, communicator_) == 1;
}

}  // namespace endoflow::phasefield
