#include "phasefield/schemes/paper/diagnostics.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/reduction.h"
#include "phasefield/fem/same_cell.h"
#include "phasefield/layer/boundary_flux.h"
#include "phasefield/schemes/paper/surface_transport.h"

namespace endoflow::phasefield::paper {

LayerIntegrals integrate_layer(const Spaces& spaces, const State& state, const Parameters& parameters) {
    const dealii::QGauss<2> quadrature(quadrature_points(parameters.phase_field));
    OldFields fields(spaces, parameters, quadrature);
    ComponentField molecules(spaces.molecules, concentration, quadrature);
    CoupledPoints points;
    LayerIntegrals out{};
    for (const auto& cell : spaces.flow.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        fields.evaluate_cell(cell, state, points);
        const ScalarField& c = molecules.on(same_cell(cell, spaces.molecules), cell_box(cell), state.molecules);
        for (std::size_t q = 0; q < points.size(); ++q) {
            const auto& p = points[q];
            const double weight =
                0.5 * two_pi * p.measure * layer_weight(p.layer.gradient, parameters.phase_field.epsilon);
            out.area += weight;
            out.molecules += weight * c.value[q];
            out.stretching += weight * p.stretching;
        }
    }
    sum_over_processes({&out.area, &out.molecules, &out.stretching}, spaces.flow.dofs.get_communicator());
    return out;
}

StepDiagnostics diagnose_step(const Spaces& spaces, const State& before, const State& state, double tau,
                              const Parameters& parameters) {
    const auto& numerics = parameters.phase_field;
    const double epsilon = numerics.epsilon;
    const dealii::QGauss<2> quadrature(quadrature_points(numerics));
    OldFields fields(spaces, parameters, quadrature);
    LocalSystem now(spaces.flow, quadrature);
    ComponentField old_level_set(spaces.flow, phi, quadrature);
    ComponentField old_molecules(spaces.molecules, concentration, quadrature);
    ComponentField molecules(spaces.molecules, concentration, quadrature);
    dealii::Vector<double> values(spaces.flow.element.n_dofs_per_cell());
    CoupledPoints points;
    StepDiagnostics out{};
    for (const auto& cell : spaces.flow.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        fields.evaluate_cell(cell, state, points);
        const ScalarField& phi_old = old_level_set.on(cell, box, before.flow);
        const auto molecule_cell = same_cell(cell, spaces.molecules);
        const auto &c_old = old_molecules.on(molecule_cell, box, before.molecules),
                   &c = molecules.on(molecule_cell, box, state.molecules);
        cell->get_dof_values(state.flow, values);
        now.start(box, values);
        const auto &ur = now.field(u_r), &uz = now.field(u_z), &lambda = now.field(tension), &g = now.field(force);
        for (std::size_t q = 0; q < points.size(); ++q) {
            const auto& p = points[q];
            const double w = two_pi * p.measure, hoop = ur.value[q] / p.r, shear = ur.z[q] + uz.r[q];
            out.bending_energy += w * energy_density(p.moment, p.bending.stiffness, epsilon);
            out.viscous_dissipation +=
                w * p.viscosity * (2 * (ur.r[q] * ur.r[q] + uz.z[q] * uz.z[q] + hoop * hoop) + shear * shear);
            out.mobility_dissipation += w * numerics.paper.mobility * g.value[q] * g.value[q];
            out.tension_power += w * lambda.value[q] * p.layer.gradient *
                                 surface_divergence(p.layer.normal_r, p.layer.normal_z, ur.r[q], hoop, uz.z[q], shear);
            const double e = concentration_force(p.phi.value, p.moment, p.bending, epsilon).value;
            out.net_vertical_force += w * (g.value[q] * p.phi.z + e * p.c_z);
            if (tau > 0)
                out.transport_power +=
                    w * e * ((c.value[q] - c_old.value[q]) / tau + ur.value[q] * p.c_r + uz.value[q] * p.c_z);
            if (std::abs(p.phi.value) > layer_edge) continue;
            const double equilibrium = (1 - p.phi.value * p.phi.value) * inverse_sqrt2 / epsilon;
            const double gradient = std::max(std::hypot(phi_old.r[q], phi_old.z[q]), 0.1 * equilibrium);
            const double thickness_error = std::abs(p.layer.gradient / equilibrium - 1);
            out.area_strain_max = std::max(out.area_strain_max, std::abs(p.stretching - 1));
            if (std::abs(p.phi.value) < layer_middle)
                out.thickness_error_max = std::max(out.thickness_error_max, thickness_error);
            out.profile_error_max = std::max(out.profile_error_max, thickness_error);
            out.motion_max = std::max(out.motion_max, std::abs(p.phi.value - phi_old.value[q]) / gradient);
        }
    }
    const MPI_Comm communicator = spaces.flow.dofs.get_communicator();
    sum_over_processes({&out.bending_energy, &out.viscous_dissipation, &out.mobility_dissipation, &out.tension_power,
                        &out.net_vertical_force, &out.transport_power},
                       communicator);
    largest_of_processes({&out.area_strain_max, &out.thickness_error_max, &out.profile_error_max, &out.motion_max},
                         communicator);
    out.extracellular_inflow =
        extracellular_inflow(spaces.flow, state.flow, u_r, u_z, phi, [](double value) { return value; });
    return out;
}

}  // namespace endoflow::phasefield::paper
