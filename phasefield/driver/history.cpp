#include "phasefield/driver/history.h"

namespace endoflow::phasefield {

const std::vector<OwnColumn<StepRecord>>& own_history_columns() {
    using R = StepRecord;
    static const std::vector<OwnColumn<R>> columns{
        {"viscous_dissipation_pN_nm_per_us", "∫ ½ ν D:D, of (21), with what the penalty of ∇·u takes",
         [](const R& r) { return r.diagnostics.viscous_dissipation; }},
        {"mobility_dissipation_pN_nm_per_us", "∫ γ g², of (21)",
         [](const R& r) { return r.diagnostics.mobility_dissipation; }},
        {"tension_power_pN_nm_per_us",
         "scheme `production`: ∫ δ_Γ λ P:∇u − δ p_Γ ∇·u; scheme `paper`: ∫ λ |∇φ| P:∇u; 0 if the membrane "
         "stretches nowhere",
         [](const R& r) { return r.diagnostics.tension_power; }},
        {"transport_power_pN_nm_per_us",
         "∫ ∂E/∂c (∂_t c + u·∇c): molecules that move along the membrane change the energy, for (40)–(41) know nothing "
         "of bending; under energetic coupling ∫ μ (∂_t c + u·∇c)",
         [](const R& r) { return r.diagnostics.transport_power; }},
        {"energy_law_residual_pN_nm_per_us",
         "d(E + E_c)/dt plus the dissipation and the tension's power minus those of transport, loads and maturation, "
         "by the trapezoidal rule; under energetic coupling the molecules' dissipation and exchange power stand for "
         "transport",
         [](const R& r) { return r.energy_law_residual; }},
        {"thickness_error_max",
         "largest relative error of the layer's thickness along the membrane, |√2 ε|∇φ|/(1 − φ²) − 1| on "
         "|φ| < 0.5 (69 % of the membrane's weight)",
         [](const R& r) { return r.diagnostics.thickness_error_max; }},
        {"profile_error_max", "the same on |φ| < 0.9, where the layers of bud and plane meet outside of a narrow neck",
         [](const R& r) { return r.diagnostics.profile_error_max; }},
        {"layer_at_neck_relative", "ε at the neck over the neck's radius; 0 without a neck",
         [](const R& r) { return r.layer_at_neck; }},
        {"motion_max_nm", "motion in the step on |φ| < 0.9", [](const R& r) { return r.diagnostics.motion_max; }},
        {"net_vertical_force_pN", "of the membrane and its loads on the fluid, which the pinned rim takes up",
         [](const R& r) { return r.diagnostics.net_vertical_force; }},
        {"extracellular_inflow_nm3_per_us", "−∮ ½(1 + φ) u·n_w, the rate at which `volume_extracellular_nm3` must grow",
         [](const R& r) { return r.diagnostics.extracellular_inflow; }},
        {"layer_area_nm2", "area of the layer", [](const R& r) { return r.integrals.area; }},
        {"sharp_bending_energy_pN_nm", "energy (S) of the layer's zero level set",
         [](const R& r) { return r.observables.bending_energy; }},
        {"unknowns", "of the coupled system", [](const R& r) { return r.unknowns; }},
        {"cells", "of the mesh", [](const R& r) { return r.cells; }},
        {"load_power_pN_nm_per_us", "power of all loads", [](const R& r) { return r.diagnostics.load_power; }},
        {"line_energy_pN_nm", "E_c of the coat's edge, under energetic coupling",
         [](const R& r) { return r.diagnostics.line_energy; }},
        {"molecule_dissipation_pN_nm_per_us", "∫ M |∇μ|² of energetic coupling",
         [](const R& r) { return r.diagnostics.molecule_dissipation; }},
        {"exchange_power_pN_nm_per_us", "E + E_c that molecules bring when they come and take when they leave",
         [](const R& r) { return r.diagnostics.exchange_power; }},
        {"maturity", "χ, the part of its curvature that the coat has", [](const R& r) { return r.maturity; }},
        {"maturation_power_pN_nm_per_us", "∂E/∂χ dχ/dt, what the coat's maturation adds to E",
         [](const R& r) { return r.diagnostics.maturation_power; }},
        {"molecules_exchanged_nm2", "∫∫ j dA dt, coat that has come from outside since t = 0",
         [](const R& r) { return r.molecules.exchanged(); }},
        {"molecule_balance_relative", "|∫ c dA − its first value − ∫∫ j dA dt| over the first value",
         [](const R& r) { return r.molecules.residual(r.integrals.molecules); }},
        {"bulk_molecules",
         "∫ χc_b, how many molecules are in the fluid that the membrane's come from; 0 without a bulk",
         [](const R& r) { return r.diagnostics.bulk.molecules; }},
        {"bulk_supply", "mean of c_b/c_∞ at the membrane, by which attachment is slower than from a reservoir",
         [](const R& r) { return r.diagnostics.bulk.supply; }},
        {"bulk_made_up_nm2", "what the walls have made up for of the bulk's depletion since t = 0, as coat",
         [](const R& r) { return r.diagnostics.bulk.made_up; }},
        {"bulk_corrected_nm2",
         "coat that the uniform j has moved since t = 0 by which fluid and membrane conserve their molecules",
         [](const R& r) { return r.diagnostics.bulk.corrected; }},
        {"bulk_balance_relative",
         "|∫ c dA + a₀ ∫ χ(c_b − c_∞) − its first value − what the walls have made up for| over the first ∫ c dA",
         [](const R& r) { return r.diagnostics.bulk.residual; }},
    };
    return columns;
}

HistoryRow make_history_row(const StepRecord& record) {
    HistoryRow row;
    row.time_us = record.time;
    row.step_us = record.tau;
    row.membrane = record.observables;
    row.membrane.bending_energy = record.diagnostics.bending_energy;
    row.membrane.molecule_mass = record.integrals.molecules;
    row.area_strain_max = record.diagnostics.area_strain_max;
    row.extra = own_values(own_history_columns(), record);
    return row;
}

}  // namespace endoflow::phasefield
