#include "phasefield/driver/history.h"

namespace endoflow::phasefield {

std::vector<std::string> extra_history_columns() {
    return {"viscous_dissipation_pN_nm_per_us",
            "mobility_dissipation_pN_nm_per_us",
            "tension_power_pN_nm_per_us",
            "transport_power_pN_nm_per_us",
            "energy_law_residual_pN_nm_per_us",
            "thickness_error_max",
            "profile_error_max",
            "motion_max_nm",
            "net_vertical_force_pN",
            "extracellular_inflow_nm3_per_us",
            "layer_area_nm2",
            "sharp_bending_energy_pN_nm",
            "unknowns",
            "cells"};
}

HistoryRow make_history_row(const StepRecord& r) {
    HistoryRow row;
    row.time_us = r.time;
    row.step_us = r.tau;
    if (r.observables.neck) {
        row.neck_radius_nm = r.observables.neck->radius;
        row.bud_diameter_nm = r.observables.neck->lateral_diameter;
    }
    row.bud_height_nm = r.observables.bud_height;
    row.membrane_area_nm2 = r.observables.membrane_area;
    row.bending_energy_pN_nm = r.diagnostics.bending_energy;
    row.molecule_mass_nm2 = r.integrals.molecules;
    row.area_strain_max = r.diagnostics.area_strain_max;
    row.volume_extracellular_nm3 = r.observables.extracellular_volume;
    row.extra = {r.diagnostics.viscous_dissipation,
                 r.diagnostics.mobility_dissipation,
                 r.diagnostics.tension_power,
                 r.diagnostics.transport_power,
                 r.energy_law_residual,
                 r.diagnostics.thickness_error_max,
                 r.diagnostics.profile_error_max,
                 r.diagnostics.motion_max,
                 r.diagnostics.net_vertical_force,
                 r.diagnostics.extracellular_inflow,
                 r.integrals.area,
                 r.observables.bending_energy,
                 r.unknowns,
                 r.cells};
    return row;
}

}  // namespace endoflow::phasefield
