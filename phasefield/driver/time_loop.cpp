#include "phasefield/driver/time_loop.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "phasefield/contour/material_force.h"
#include "phasefield/driver/clearance.h"
#include "phasefield/driver/history.h"
#include "phasefield/fem/interruption.h"
#include "shared/geometry/axisymmetric_spline.h"
#include "shared/model/loads.h"
#include "shared/model/maturation.h"
#include "shared/model/membrane_energy.h"
#include "shared/output/phase_timer.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// The diffuse engine follows a neck until the membrane comes apart there.
constexpr double closed_radius = 0;

/// By which a neck may miss the radius at which its collar is placed [nm]: a tenth of what the layer leaves of a neck's
/// radius.
constexpr double collar_miss = 0.01;

/// Between which of increasing numbers a value is, and the part of the way.
std::pair<std::size_t, double> place_on(const std::vector<double>& numbers, double value) {
    const auto behind = std::upper_bound(numbers.begin() + 1, numbers.end() - 1, value) - numbers.begin();
    const auto i = static_cast<std::size_t>(behind) - 1;
    return {i, (value - numbers[i]) / (numbers[i + 1] - numbers[i])};
}

double start_of(const RunOutput& output) {
    return output.restart_point() ? output.restart_point()->time_us : 0;
}

}  // namespace

TimeLoop::TimeLoop(const Parameters& parameters, RunOutput& output, MPI_Comm communicator,
                   std::unique_ptr<Scheme> scheme)
    : parameters_(parameters),
      output_(output),
      communicator_(communicator),
      scheme_(std::move(scheme)),
      plan_(parameters, start_of(output)),
      events_(parameters.output, closed_radius) {
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
    neck_radius_ = neck_radius_at(0);
}

ExitReason TimeLoop::run() {
    ExitReason reason = ExitReason::interrupted;
    try {
        reason = step_to_an_end();
    } catch (const Interrupted&) {
        output_.log_info("the step after t = " + std::to_string(time_) + " µs was given up");
    }
    if (reason != ExitReason::interrupted) plan_.shape_at(time_, [this](double time) { write_shape(time); });
    checkpoint();
    return reason;
}

ExitReason TimeLoop::step_to_an_end() {
    while (true) {
        if (const auto reason = reason_to_stop()) return *reason;
        step();
        check_clearance();
        write_due_output();
        place_collar();
        follow();
        if (anywhere(output_.checkpoint_due())) checkpoint();
    }
}

std::optional<ExitReason> TimeLoop::reason_to_stop() {
    if (time_ >= parameters_.time.end * (1 - same_time)) return ExitReason::done;
    if (interrupted(communicator_)) return ExitReason::interrupted;
    return event_end_;
}

void TimeLoop::step() {
    double deadline = parameters_.time.end;
    while (true) {
        const double tau = scheme_->step(time_, deadline);
        if (const auto outcome = attempt(tau)) {
            if (const auto earlier = collar_due(*outcome, tau)) {
                deadline = *earlier;
                continue;
            }
            keep(*outcome, tau);
            return;
        }
        output_.count_rejected_step();
        scheme_->reject(time_, tau);
    }
}

std::optional<double> TimeLoop::collar_due(const StepOutcome& outcome, double tau) const {
    if (!scheme_->collar_waits()) return {};
    const double before = neck_radius_, after = neck_radius_of(outcome.contour, time_ + tau);
    if (after >= Loads::collar_radius - collar_miss) return {};
    const double part = std::isfinite(before) ? (before - Loads::collar_radius) / (before - after) : 0.5;
    return time_ + part * tau;
}

void TimeLoop::place_collar() {
    if (!scheme_->collar_waits() || neck_radius_ > Loads::collar_radius + collar_miss) return;
    const MembraneCurve& curve = contour_.curve;
    const auto [i, part] = place_on(chord_length(curve.r, curve.z), observables_.neck->t);
    const std::vector<double> area = area_from_pole(curve);
    const double place = area[i] + part * (area[i + 1] - area[i]);
    scheme_->place_collar(place);
    last_loss_ = 0;
    record({"collar", time_, {}});
    output_.log_info("the collar sits at a material radius of " + std::to_string(std::sqrt(place / std::numbers::pi)) +
                     " nm");
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
    note_solver();
    watch_neck(tau);
}

void TimeLoop::follow() {
    const PhaseTimer timer(output_, "mesh adaptation");
    scheme_->follow(contour_.curve);
}

void TimeLoop::record(double tau, const StepDiagnostics& diagnostics) {
    const PhaseTimer timer(output_, "observables");
    observables_ = measure(contour_.curve, model(time_));
    if (tau > 0) molecules_.advance(time_, diagnostics.exchange_rate, diagnostics.molecules_put_right);
    const double molecular = energetically_coupled(parameters_.molecules)
                                 ? diagnostics.exchange_power - diagnostics.molecule_dissipation
                                 : diagnostics.transport_power;
    const double loss = diagnostics.viscous_dissipation + diagnostics.mobility_dissipation + diagnostics.tension_power -
                        molecular - diagnostics.load_power - diagnostics.maturation_power;
    // (21) over the step, the power by the trapezoidal rule; the first step starts from rest in an instant.
    const double power = last_loss_ != 0 ? 0.5 * (last_loss_ + loss) : loss;
    const double energy = diagnostics.bending_energy + diagnostics.line_energy;
    const double residual = tau > 0 ? (energy - last_energy_) / tau + power : 0;
    last_energy_ = energy;
    last_loss_ = loss;
    output_.record_step(make_history_row({time_, tau, diagnostics, scheme_->integrate(), observables_,
                                          MaturationLaw(parameters_.molecules).maturity(time_), residual, molecules_,
                                          scheme_->unknowns(), scheme_->cells(), layer_at_neck()}));
}

double TimeLoop::layer_at_neck() const {
    if (!observables_.neck) return 0;
    const std::vector<double>&r = contour_.curve.r, &z = contour_.curve.z;
    const std::size_t i = place_on(chord_length(r, z), observables_.neck->t).first;
    return scheme_->thickness_at(r[i], z[i]) / observables_.neck->radius;
}

void TimeLoop::note_solver() const {
    auto counts = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scheme_->solver_counts()) counts[name] = static_cast<std::int64_t>(value);
    if (!counts.empty()) output_.note("solver", counts);
}

double TimeLoop::neck_radius_of(const Contour& contour, double time) const {
    return contour.components > 1 ? 0 : neck_radius(measure(contour.curve, model(time)).neck);
}

double TimeLoop::neck_radius_at(double time) const {
    if (time >= time_) return contour_.components > 1 ? 0 : neck_radius(observables_.neck);
    return neck_radius_of(scheme_->contour_at(time), time);
}

void TimeLoop::watch_neck(double tau) {
    const double begin = time_ - tau, before = neck_radius_, now = neck_radius_at(time_);
    const auto radius = [&](double time) {
        if (time <= begin) return before;
        return time >= time_ ? now : neck_radius_at(time);
    };
    for (const NeckEvent& event : events_.within(begin, time_, radius)) {
        record(event);
        if (event.ends_run) event_end_ = event.ends_run;
    }
    neck_radius_ = now;
}

void TimeLoop::record(const NeckEvent& event) {
    output_.record_event(event.name, event.time, measure(curve_at(event.time), model(event.time)));
    plan_.shape_at(event.time, [this](double time) { write_shape(time); });
}

void TimeLoop::check_clearance() const {
    require_clearance(contour_.curve, parameters_, time_);
}

MembraneCurve TimeLoop::curve_at(double time) const {
    return time >= time_ * (1 - same_time) ? contour_.curve : scheme_->contour_at(time).curve;
}

void TimeLoop::write_shape(double time) {
    output_.write_shape(time, curve_at(time));
}

void TimeLoop::write_due_output() {
    const auto shape = [this](double time) { write_shape(time); };
    const auto fields = [this](double time) { write_fields(std::min(time, time_)); };
    plan_.shapes_until(time_, shape);
    plan_.fields_until(time_, fields);
    if (time_ < parameters_.time.end * (1 - same_time)) return;
    plan_.shape_at(time_, shape);
    if (parameters_.output.field_interval > 0) plan_.fields_at(time_, fields);
}

void TimeLoop::write_fields(double time) {
    const PhaseTimer timer(output_, "field output");
    scheme_->write_fields(output_.directory(), field_times_, time);
}

bool TimeLoop::anywhere(bool here) const {
    return dealii::Utilities::MPI::max(here ? 1 : 0, communicator_) == 1;
}

}  // namespace endoflow::phasefield
