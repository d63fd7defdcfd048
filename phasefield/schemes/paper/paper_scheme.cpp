#include "phasefield/schemes/paper/paper_scheme.h"

#include <algorithm>
#include <cmath>

#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/paper/paper_step.h"
#include "phasefield/schemes/paper/state_files.h"

namespace endoflow::phasefield::paper {

namespace {

/// The mesh follows when the membrane may have moved this far since it was made; in units of ε.
constexpr double adapt_after_motion = 0.4;

/// By (21) the energy falls. A step in which it more than doubles, and not by round-off alone, is no solution.
bool grows_wildly(double before, double after, const MembraneParameters& membrane) {
    return after > 2 * before + membrane.bending_stiffness;
}

}  // namespace

PaperScheme::PaperScheme(const Parameters& parameters, MPI_Comm communicator)
    : discretization_(parameters, communicator), control_(parameters) {}

StepOutcome PaperScheme::begin() {
    const Spaces& spaces = discretization_.spaces;
    const StepDiagnostics diagnostics = diagnose_step(spaces, state_, state_, 0, discretization_.parameters);
    energy_ = diagnostics.bending_energy;
    return {diagnostics, extract_contour(contour_fields(spaces, state_), discretization_.parameters), {}};
}

StepOutcome PaperScheme::start() {
    take_over(state_, initial_state(discretization_));
    return begin();
}

StepOutcome PaperScheme::load(const std::filesystem::path& directory, const Checkpoint& checkpoint) {
    control_.nominal = checkpoint.scalar("nominal_step");
    control_.since_doubling = checkpoint.scalar("steps_since_doubling");
    moved_ = checkpoint.scalar("moved");
    take_over(state_, load_mesh_and_state(directory, discretization_));
    return begin();
}

void PaperScheme::save(const std::filesystem::path& directory, Checkpoint& checkpoint) {
    checkpoint.scalars["nominal_step"] = control_.nominal;
    checkpoint.scalars["steps_since_doubling"] = control_.since_doubling;
    checkpoint.scalars["moved"] = moved_;
    save_mesh_and_state(directory, discretization_, state_);
}

StepOutcome PaperScheme::attempt(double /*time*/, double tau) {
    const Spaces& spaces = discretization_.spaces;
    take_over(trial_, advance(discretization_, state_, tau));
    StepOutcome outcome{diagnose_step(spaces, state_, trial_, tau, discretization_.parameters), {}, {}};
    const double motion = outcome.diagnostics.motion_max, energy = outcome.diagnostics.bending_energy;
    if (control_.too_far(motion) || !std::isfinite(energy))
        outcome.rejection = "motion " + std::to_string(motion) + " nm";
    else if (grows_wildly(energy_, energy, discretization_.parameters.membrane))
        outcome.rejection =
            "bending energy from " + std::to_string(energy_) + " to " + std::to_string(energy) + " pN nm";
    else
        outcome.contour = extract_contour(contour_fields(spaces, trial_), discretization_.parameters);
    return outcome;
}

void PaperScheme::keep(double time, double tau, const StepOutcome& outcome) {
    take_over(before_, std::move(state_));
    take_over(state_, std::move(trial_));
    time_ = time + tau;
    last_step_ = tau;
    control_.accept(tau, outcome.diagnostics.motion_max);
    moved_ += outcome.diagnostics.motion_max;
    energy_ = outcome.diagnostics.bending_energy;
}

void PaperScheme::reject(double time, double /*tau*/) {
    discretization_.coupled.forget_factors();
    control_.reject(time);
}

void PaperScheme::follow(const MembraneCurve& curve) {
    if (moved_ < adapt_after_motion * discretization_.parameters.phase_field.epsilon) return;
    adapt(discretization_, state_, positions(curve));
    moved_ = 0;
}

State PaperScheme::state_at(double time) const {
    State state = state_;
    const double weight = last_step_ > 0 ? std::clamp((time_ - time) / last_step_, 0.0, 1.0) : 0;
    const auto mix = [weight](Vector& end, const Vector& begin) {
        if (weight > 0) end.sadd(1 - weight, weight, begin);
        end.update_ghost_values();
    };
    mix(state.flow, before_.flow);
    mix(state.molecules, before_.molecules);
    mix(state.stretching, before_.stretching);
    return state;
}

Contour PaperScheme::contour_at(double time) const {
    return extract_contour(contour_fields(discretization_.spaces, state_at(time)), discretization_.parameters);
}

LayerIntegrals PaperScheme::integrate() const {
    return integrate_layer(discretization_.spaces, state_, discretization_.parameters);
}

void PaperScheme::write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                               double time) const {
    paper::write_fields(run_directory, times, time, discretization_.spaces, state_at(time),
                        discretization_.parameters.phase_field.paper);
}

double PaperScheme::thickness_at(double /*r*/, double /*z*/) const {
    return discretization_.parameters.phase_field.epsilon;
}

double PaperScheme::unknowns() const {
    return static_cast<double>(discretization_.spaces.flow.dofs.n_dofs());
}

double PaperScheme::cells() const {
    return static_cast<double>(discretization_.mesh->n_global_active_cells());
}

}  // namespace endoflow::phasefield::paper
