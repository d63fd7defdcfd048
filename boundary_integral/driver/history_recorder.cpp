#include "boundary_integral/driver/history_recorder.h"

#include <numbers>
#include <utility>

#include "boundary_integral/driver/run_checks.h"
#include "boundary_integral/flow/free_space_flow.h"

namespace endoflow::boundary_integral {

namespace {

/// All zero without a fluid.
FlowBalances balances(const MembraneDynamics& dynamics, const Evaluation& e) {
    if (e.flow.force.size() == 0) return {};
    if (const BoxFlow* box = dynamics.box())
        return flow_balances(dynamics.space(), *box, *e.operators, e.samples, e.flow);
    return flow_balances(dynamics.space(), *e.operators, e.samples, e.flow);
}

}  // namespace

std::vector<std::string> own_history_columns() {
    return {"dissipated_power_pN_nm_per_us",
            "energy_rate_pN_nm_per_us",
            "energy_balance_relative",
            "force_balance_relative",
            "net_flux_relative",
            "area_balance_relative",
            "inflow_nm_per_us",
            "wall_distance_nm",
            "integrator_order",
            "load_power_pN_nm_per_us"};
}

HistoryRecorder::HistoryRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output)
    : parameters_(parameters), dynamics_(dynamics), output_(output), strain_(dynamics.space()) {}

void HistoryRecorder::record(double time, const Evaluation& evaluation, int order) {
    const PhaseTimer timer(output_, "observables");
    const ShapeIntegrals shape = shape_integrals(dynamics_.space(), evaluation.state, parameters_.domain);
    check_walls(shape, parameters_.domain, time);
    check_stiffness(evaluation.samples.c, dynamics_.model(), parameters_, time);
    HistoryRow row;
    row.time_us = time;
    row.step_us = time - last_row_;
    if (const auto neck = find_neck(dynamics_.space(), evaluation.state)) {
        row.neck_radius_nm = neck->radius;
        row.bud_diameter_nm = 2.0 * neck->widest_radius;
    }
    row.bud_height_nm = shape.height;
    row.membrane_area_nm2 = shape.area;
    row.bending_energy_pN_nm = 2.0 * std::numbers::pi * evaluation.energy.energy;
    row.molecule_mass_nm2 = shape.mass;
    MaterialRates strain_rates = strain_.rates(evaluation);
    strain_.advance(strain_rates_, strain_rates, row.step_us);
    strain_rates_ = std::move(strain_rates);
    row.area_strain_max = strain_.largest();
    row.volume_extracellular_nm3 = shape.extracellular_volume;
    row.extra = own_values(evaluation, shape, order);
    output_.record_step(row);
    last_row_ = time;
}

std::vector<double> HistoryRecorder::own_values(const Evaluation& evaluation, const ShapeIntegrals& shape,
                                                int order) const {
    const FlowBalances flow = balances(dynamics_, evaluation);
    const EnergyBalance energy = energy_balance(dynamics_, evaluation);
    return {energy.dissipated_power,
            energy.energy_rate,
            energy.residual(),
            flow.force,
            flow.net_flux,
            flow.area,
            evaluation.flow.inflow,
            shape.wall_distance,
            static_cast<double>(order),
            energy.external_power};
}

void HistoryRecorder::save(Checkpoint& checkpoint) const {
    checkpoint.scalars["last_row"] = last_row_;
    checkpoint.arrays["marker_xi"] = strain_.markers().xi;
    checkpoint.arrays["marker_log_growth"] = strain_.markers().log_growth;
    checkpoint.arrays["marker_drift_rate"] = strain_rates_.drift;
    checkpoint.arrays["marker_growth_rate"] = strain_rates_.growth;
}

void HistoryRecorder::restore(const Checkpoint& checkpoint) {
    last_row_ = checkpoint.scalar("last_row");
    strain_.restore({checkpoint.array("marker_xi"), checkpoint.array("marker_log_growth")});
    strain_rates_ = {checkpoint.array("marker_drift_rate"), checkpoint.array("marker_growth_rate")};
}

}  // namespace endoflow::boundary_integral
