#include "phasefield/schemes/production/diagnostics.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/reduction.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/constants.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double hardly_present = constant("hardly_present");

}  // namespace

SolutionMeasures measure_solution(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                                  const Vector& before, const Vector& predicted, const Vector& rate,
                                  const Vector& solution) {
    const auto& numerics = step.numerics;
    const dealii::QGauss<2> quadrature(gauss_points(numerics));
    LocalSystem local(space, quadrature);
    ComponentField molecule_rate(space, molecule_density, quadrature);
    SupplyAtPoints supply(step.supply, quadrature);
    ComponentField old_distance(space, distance, quadrature), predicted_distance(space, distance, quadrature);
    dealii::Vector<double> values(space.element.n_dofs_per_cell());
    SolutionMeasures out{};
    auto& [integrals, diagnostics, difference, layer_motion, molecules_rate] = out;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        cell->get_dof_values(solution, values);
        local.start(box, values);
        const auto &old_psi = old_distance.on(cell, box, before), &guess = predicted_distance.on(cell, box, predicted),
                   &c_rate = molecule_rate.on(cell, box, rate);
        const auto& bulk = supply.on(cell, box);
        const auto &ur = local.field(velocity_r), &uz = local.field(velocity_z), &psi = local.field(distance),
                   &lambda = local.field(tension), &layer_pressure = local.field(pressure_layer),
                   &c = local.field(molecule_density), &s = local.field(membrane_stretch), &b = local.field(moment),
                   &mu = local.field(molecule_potential), &g = local.field(normal_force);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double r = box.r0 + box.hr * quadrature.point(q)[0];
            const double w = two_pi * quadrature.weight(q) * box.hr * box.hz * r;
            const auto& at = quadrature.point(q);
            const PointThickness thickness = step.thickness_at(cell->active_cell_index(), box, at[0], at[1]);
            const double epsilon = thickness.value;
            const AtPoint<double> distance_here{psi.value[q], psi.r[q], psi.z[q]};
            const auto layer = layer_profile(psi.value[q], epsilon);
            const double gradient = std::hypot(psi.r[q], psi.z[q]), density = membrane_density(layer, step.weight);
            const auto sheet = sheet_gradient(distance_here, thickness);
            const double length = std::hypot(sheet.r, sheet.z, gradient_floor);
            const double slope = (c.z[q] * sheet.r - c.r[q] * sheet.z) / length;
            const auto state = sheet_state(energy, b.value[q], c.value[q], slope,
                                           sheet_curvature(psi.r[q], r, epsilon).scaled, epsilon);
            const auto& elastic = state.elastic;
            const double nu = layer_viscosity(layer.phi, step.fluid, step.weight, numerics.viscosity_mean);
            const double hoop = ur.value[q] / r, shear = ur.z[q] + uz.r[q], divergence = ur.r[q] + hoop + uz.z[q];
            const double stretching =
                surface_divergence(sheet.r / length, sheet.z / length, ur.r[q], hoop, uz.z[q], shear);
            integrals.area += w * layer.delta;
            integrals.molecules += w * density * c.value[q];
            integrals.stretching += w * density * s.value[q];
            const auto weight = energy_weight(layer, psi.value[q], epsilon);
            diagnostics.bending_energy += w * energy_per_volume({b.value[q], b.r[q], b.z[q]}, distance_here, elastic,
                                                                weight.value, epsilon, energy);
            diagnostics.viscous_dissipation += w * nu *
                                               (2 * (ur.r[q] * ur.r[q] + uz.z[q] * uz.z[q] + hoop * hoop) +
                                                shear * shear + step.divergence_penalty * divergence * divergence);
            if (step.fluid.dynamics == Dynamics::geometric)
                diagnostics.mobility_dissipation += w * step.fluid.normal_mobility * g.value[q] * g.value[q] * density;
            diagnostics.tension_power +=
                w * (density * lambda.value[q] * stretching - layer.delta * layer_pressure.value[q] * divergence);
            // δ(E + E_c)/δc where the energy is coupled.
            const double potential = energy.coupled ? mu.value[q] : state.by_concentration;
            if (energy.coupled) {
                const double line =
                    w * weight.value * energy.edge.density(elastic.curvature, c.value[q], slope * slope).value;
                diagnostics.line_energy += line;
                diagnostics.bending_energy -= line;
                const double driven = (mu.z[q] * sheet.r - mu.r[q] * sheet.z) / length;
                diagnostics.molecule_dissipation += w * step.transport.mobility * weight.value * driven * driven;
            }
            if (!step.exchange.none()) {
                const double coming = step.exchange.rate<double>(
                    c.value[q], bending_by_concentration(energy, state, c.value[q]), step.molecules, bulk[q]);
                diagnostics.exchange_rate += w * density * coming;
                diagnostics.exchange_power += w * density * coming * potential;
            }
            diagnostics.transport_power +=
                w * density * potential * (c_rate.value[q] + ur.value[q] * c.r[q] + uz.value[q] * c.z[q]);
            if (std::abs(layer.phi) > layer_edge) continue;
            diagnostics.area_strain_max = std::max(diagnostics.area_strain_max, std::abs(s.value[q] - 1));
            const double thickness_error = std::abs(gradient - 1);
            if (std::abs(layer.phi) < layer_middle)
                diagnostics.thickness_error_max = std::max(diagnostics.thickness_error_max, thickness_error);
            diagnostics.profile_error_max = std::max(diagnostics.profile_error_max, thickness_error);
            const double motion = std::abs(psi.value[q] - old_psi.value[q]);
            diagnostics.motion_max = std::max(diagnostics.motion_max, motion);
            molecules_rate = std::max(molecules_rate, std::abs(c_rate.value[q]));
            layer_motion = std::max(layer_motion, motion * numerics.epsilon / epsilon);
            if (std::abs(layer.phi) < layer_middle)
                difference = std::max(difference, std::abs(psi.value[q] - guess.value[q]));
        }
    }
    const MPI_Comm communicator = space.dofs.get_communicator();
    sum_over_processes({&integrals.area, &integrals.molecules, &integrals.stretching, &diagnostics.bending_energy,
                        &diagnostics.viscous_dissipation, &diagnostics.mobility_dissipation, &diagnostics.tension_power,
                        &diagnostics.transport_power, &diagnostics.line_energy, &diagnostics.molecule_dissipation,
                        &diagnostics.exchange_rate, &diagnostics.exchange_power},
                       communicator);
    largest_of_processes(
        {&diagnostics.area_strain_max, &diagnostics.thickness_error_max, &diagnostics.profile_error_max,
         &diagnostics.motion_max, &difference, &layer_motion, &molecules_rate},
        communicator);
    return out;
}

SolutionMeasures measure_solution(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                                  const Vector& solution) {
    Vector at_rest = space.vector();
    at_rest.update_ghost_values();
    return measure_solution(space, energy, step, solution, solution, at_rest, solution);
}

std::vector<double> molecules_of(const Space& space, const StepNumbers& step, const std::vector<Vector>& solutions) {
    const dealii::QGauss<2> quadrature(gauss_points(step.numerics));
    ComponentField psi(space, distance, quadrature), c(space, molecule_density, quadrature);
    std::vector<double> sums(solutions.size());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        for (std::size_t j = 0; j < solutions.size(); ++j) {
            const auto &position = psi.on(cell, box, solutions[j]), &density = c.on(cell, box, solutions[j]);
            for (unsigned int q = 0; q < quadrature.size(); ++q) {
                const auto& x = quadrature.point(q);
                const double epsilon = step.thickness_at(cell->active_cell_index(), box, x[0], x[1]).value;
                const double weight = membrane_density(layer_profile(position.value[q], epsilon), step.weight);
                const double r = box.r0 + box.hr * x[0];
                sums[j] += two_pi * quadrature.weight(q) * box.hr * box.hz * r * weight * density.value[q];
            }
        }
    }
    dealii::Utilities::MPI::sum(sums, space.dofs.get_communicator(), sums);
    return sums;
}

double layer_increment(const Space& space, const StepNumbers& step, const Vector& increment, const Vector& solution) {
    const dealii::QGauss<2> quadrature(space.degrees[distance] + 1);
    ComponentField change(space, distance, quadrature), psi(space, distance, quadrature);
    double largest = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        const auto &present = psi.on(cell, box, solution), &d = change.on(cell, box, increment);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const auto& x = quadrature.point(q);
            const double epsilon = step.thickness_at(cell->active_cell_index(), box, x[0], x[1]).value;
            if (std::abs(equilibrium_profile(present.value[q], epsilon)) <= layer_edge)
                largest = std::max(largest, std::abs(d.value[q]) * step.numerics.epsilon / epsilon);
        }
    }
    return dealii::Utilities::MPI::max(largest, space.dofs.get_communicator());
}

Vector presence(const Space& space, const StepNumbers& step, const Vector& solution) {
    Vector out = space.vector();
    out = 1;
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (unsigned int field = 0; field < n_fields; ++field) {
        if (lives_in_fluid(field)) continue;
        const auto points = nodes(space.degrees[field]);
        ComponentField psi(space, distance, points);
        for (const auto& cell : space.dofs.active_cell_iterators()) {
            if (!cell->is_locally_owned()) continue;
            const CellBox box = cell_box(cell);
            const auto& there = psi.on(cell, box, solution);
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < points.size(); ++i) {
                const auto unknown = indices[space.local[field][i]];
                if (!space.owned.is_element(unknown)) continue;
                const auto& x = points.point(i);
                const double epsilon = step.thickness_at(cell->active_cell_index(), box, x[0], x[1]).value;
                const double well = layer_profile(there.value[i], epsilon).squared_well;
                out(unknown) = kept_by_cut(well * well, hardly_present * hardly_present);
            }
        }
    }
    return out;
}

}  // namespace endoflow::phasefield::production
