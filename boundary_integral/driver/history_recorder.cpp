#include "boundary_integral/driver/history_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "boundary_integral/evolution/resolution_estimate.h"
#include "boundary_integral/flow/free_space_flow.h"
#include "shared/model/time_scale.h"
#include "shared/output/phase_timer.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

/// Relative error of neck radius and budding time over time.tolerance: measured, 0.4 to 2.
constexpr double error_of_steps = 2.0;

/// Part of structure_time in which what is left of an interpolation to other elements has relaxed. Measured: the
/// energy's balance, off by up to 0.7 of a small power, is what it was before after a fifth.
constexpr double settling_part = 0.37;

/// All zero without a fluid.
FlowBalances balances(const MembraneDynamics& dynamics, const Evaluation& e, const RestLevel& rest) {
    if (e.flow.force.size() == 0) return {};
    if (const BoxFlow* box = dynamics.box())
        return flow_balances(dynamics.space(), *box, *e.operators, e.samples, e.flow, rest);
    return flow_balances(dynamics.space(), *e.operators, e.samples, e.flow, rest);
}

/// Jump of c's fifth derivative from which on c overshoots by tenths. Below it, it does by the hundredths of a resolved
/// edge, and a law that does not stand them is to blame.
constexpr double unresolved = 2.0;

/// Beside the coat's edge c leaves [0, 1] by some hundredths. That is harmless as long as b(c) stays positive; bending
/// with a negative stiffness is ill-posed, and no time step would be small enough: SolverError("negative-stiffness").
void check_stiffness(const Evaluation& evaluation, const MembraneDynamics& dynamics, const Parameters& parameters,
                     double time) {
    for (const double c : evaluation.samples.c) {
        if (dynamics.model(time).stiffness(c).value > 0.0) continue;
        if (estimate_resolution(dynamics.space(), evaluation.state).concentration > unresolved)
            throw SolverError("unresolved-coat-edge",
                              fmt::format("c = {:.6f} at t = {:.6f} µs, where the bending stiffness is no longer "
                                          "positive, beside the coat's edge: boundary_integral.elements = {} do not "
                                          "resolve molecules.interface_width = {:g} nm",
                                          c, time, dynamics.space().elements(), parameters.molecules.interface_width),
                              "raise one of them");
        throw SolverError("negative-stiffness",
                          fmt::format("the law of membrane.constitutive_law gives no positive bending stiffness at "
                                      "c = {:.6f}, beside the edge of the coat, at t = {:.6f} µs",
                                      c, time),
                          "bring membrane.bending_stiffness and bending_stiffness_coated nearer to each other, or "
                          "choose another membrane.constitutive_law");
    }
}

}  // namespace

const std::vector<OwnColumn<StepBalances>>& own_history_columns() {
    using B = StepBalances;
    static const std::vector<OwnColumn<B>> columns{
        {"dissipated_power_pN_nm_per_us", "∫ f·u", [](const B& b) { return b.energy.dissipated_power; }},
        {"energy_rate_pN_nm_per_us", "d(E + E_c)/dt along the computed motion",
         [](const B& b) { return b.energy.energy_rate; }},
        {"energy_balance_relative",
         "|dE/dt + ∫ f·u − diffusion| / ∫ f·u, with all that changes c in the material, and with the two powers below "
         "added to ∫ f·u; at rest over the level of rest",
         [](const B& b) { return b.energy.residual(b.power_floor); }},
        {"force_balance_relative", "forces of membrane and pin band against the tractions on the walls",
         [](const B& b) { return b.flow.force; }},
        {"net_flux_relative", "volume flux out of each phase", [](const B& b) { return b.flow.net_flux; }},
        {"area_balance_relative", "area growth against inflow of membrane", [](const B& b) { return b.flow.area; }},
        {"inflow_nm_per_us", "u_r at the rim", [](const B& b) { return b.inflow; }},
        {"wall_distance_nm", "to the nearest wall, the rim's neighbourhood left out; empty without walls",
         [](const B& b) { return b.wall_distance; }},
        {"integrator_order", "order of the time step", [](const B& b) { return static_cast<double>(b.order); }},
        {"load_power_pN_nm_per_us", "power of all loads", [](const B& b) { return b.energy.external_power; }},
        {"line_energy_pN_nm", "E_c of the coat's edge, under energetic coupling",
         [](const B& b) { return b.line_energy; }},
        {"molecule_dissipation_pN_nm_per_us", "∫ M |∇μ|² of energetic coupling",
         [](const B& b) { return b.energy.molecular_dissipation; }},
        {"exchange_power_pN_nm_per_us", "E + E_c that molecules bring when they come and take when they leave",
         [](const B& b) { return b.energy.exchange_power; }},
        {"molecules_exchanged_nm2", "∫∫ j dA dt, coat that has come from outside since t = 0",
         [](const B& b) { return b.exchanged; }},
        {"molecule_balance_relative", "|∫ c dA − its first value − ∫∫ j dA dt| over the first value",
         [](const B& b) { return b.molecule_balance; }},
        {"maturity", "χ, the part of its curvature that the coat has", [](const B& b) { return b.maturity; }},
        {"maturation_power_pN_nm_per_us", "∂E/∂χ dχ/dt, what the coat's maturation adds to E",
         [](const B& b) { return b.energy.maturation_power; }},
        {"resolution_error_relative", "estimate of the error of neck radius and budding time: elements and time steps",
         [](const B& b) { return b.resolution_error; }},
    };
    return columns;
}

HistoryRecorder::HistoryRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output)
    : parameters_(parameters),
      dynamics_(dynamics),
      output_(output),
      rest_(rest_level(parameters)),
      strain_(dynamics.space()) {}

void HistoryRecorder::start(const Evaluation& evaluation) {
    strain_rates_ = strain_.rates(evaluation);
    molecules_.start(molecule_mass(dynamics_.space(), evaluation.samples));
}

void HistoryRecorder::settle(double since) {
    settled_from_ = since + settling_part * structure_time(parameters_);
}

void HistoryRecorder::record(double time, const Evaluation& evaluation, const StiffIntegrator& integrator) {
    const PhaseTimer timer(output_, "observables");
    const MembraneSpace& space = dynamics_.space();
    const DomainParameters& domain = parameters_.domain;
    std::optional<WallDistance> walls;
    if (domain.kind == DomainKind::box) {
        walls = wall_distance(space, evaluation.samples, domain);
        walls->require_clearance(time);
    }
    check_stiffness(evaluation, dynamics_, parameters_, time);
    const double line_energy =
        energetically_coupled(parameters_.molecules) ? dynamics_.line_energy(evaluation.state) : 0.0;
    HistoryRow row;
    row.time_us = time;
    row.step_us = time - last_row_;
    row.settling = time < settled_from_;
    row.membrane = {measure_shape(space, evaluation.state, domain), molecule_mass(space, evaluation.samples),
                    2.0 * std::numbers::pi * evaluation.energy.energy - line_energy};
    MaterialRates strain_rates = strain_.rates(evaluation);
    strain_.advance(strain_rates_, strain_rates, row.step_us);
    strain_rates_ = std::move(strain_rates);
    row.area_strain_max = strain_.largest();
    molecules_.advance(last_row_, time,
                       [&](double t) { return dynamics_.exchanged_per_time(t, integrator.state_at(t)); });
    const EnergyBalance energy = energy_balance(dynamics_, evaluation);
    largest_power_ = std::max(largest_power_, energy.moduli());
    const double power_floor = rest_floor(0.0, largest_power_, rest_.power);
    energy_balance_ = row.settling ? 0.0 : energy.residual(power_floor);
    row.extra =
        own_values(own_history_columns(),
                   {energy, power_floor, balances(dynamics_, evaluation, rest_), evaluation.flow.inflow,
                    walls ? std::optional(walls->smallest()) : std::nullopt, integrator.last_order(), line_energy,
                    molecules_.exchanged(), molecules_.residual(row.membrane.molecule_mass, rest_.area),
                    dynamics_.maturation().maturity(time), resolution_error(evaluation.state)});
    output_.record_step(row);
    last_row_ = time;
}

double HistoryRecorder::resolution_error(const MembraneState& state) const {
    return estimate_resolution(dynamics_.space(), state).relative_error() + error_of_steps * parameters_.time.tolerance;
}

void HistoryRecorder::save(Checkpoint& checkpoint) const {
    checkpoint.scalars["last_row"] = last_row_;
    checkpoint.scalars["largest_power"] = largest_power_;
    checkpoint.scalars["first_molecule_mass"] = molecules_.first_mass();
    checkpoint.scalars["molecules_exchanged"] = molecules_.exchanged();
    checkpoint.arrays["marker_xi"] = strain_.markers().xi;
    checkpoint.arrays["marker_log_growth"] = strain_.markers().log_growth;
    checkpoint.arrays["marker_drift_rate"] = strain_rates_.drift;
    checkpoint.arrays["marker_growth_rate"] = strain_rates_.growth;
}

void HistoryRecorder::restore(const Checkpoint& checkpoint) {
    last_row_ = checkpoint.scalar("last_row");
    largest_power_ = checkpoint.scalar("largest_power");
    molecules_ = {checkpoint.scalar("first_molecule_mass"), checkpoint.scalar("molecules_exchanged")};
    strain_.restore({checkpoint.array("marker_xi"), checkpoint.array("marker_log_growth")});
    strain_rates_ = {checkpoint.array("marker_drift_rate"), checkpoint.array("marker_growth_rate")};
}

}  // namespace endoflow::boundary_integral
