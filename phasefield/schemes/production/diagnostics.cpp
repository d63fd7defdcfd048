#include "phasefield/schemes/production/diagnostics.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/reduction.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/cell_points.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double hardly_present = constant("hardly_present");

}  // namespace

namespace {

/// What a point has at the end of a step, and what it adds to the measures.
struct PointState {
    PointState(const CellPoint& at, const Fields<double>& fields, const LayerEnergy& energy, const StepNumbers& step)
        : x(fields),
          epsilon(at.thickness.value),
          layer(layer_profile(x[distance].value, epsilon)),
          delta_E(energy_weight(x[distance].value, epsilon).value),
          delta_Gamma(phasefield::delta_Gamma(layer, step.weight)),
          N(sheet_normal(x[distance], at.thickness).N_epsilon),
          along(along_sheet(x[molecule_density], N)),
          elastic(sheet_state(
              energy,
              sheet_point(energy, x[moment].value, x[molecule_density].value, along, x[distance].r, at.r, epsilon),
              epsilon)),
          e_c(energy.coupled ? x[molecule_potential].value : elastic.by_concentration) {}

    const Fields<double>& x;
    double epsilon;
    LayerProfile<double> layer;
    double delta_E, delta_Gamma;
    Direction N;   // N_ε
    double along;  // ∂ₜc
    SheetState elastic;
    double e_c;  // or μ
};

/// (L) per volume where it is stationary over m [pN/nm²].
double energy_per_volume(const PointState& at, const LayerEnergy& energy) {
    const auto& m = at.x[moment];
    const double tilt = dot(at.x[distance], m);
    return at.delta_E * (at.elastic.density + 0.5 * energy.compliance(at.epsilon) * tilt * tilt) +
           0.5 * energy.smoothing(at.epsilon) * dot(m, m);
}

/// ∂e/∂χ dχ/dt = m C(c) dχ/dt per volume, C where χ = 1 [pN/(nm² µs)].
double maturation_power(const PointState& at, const StepNumbers& step) {
    if (step.maturation_rate == 0) return 0;
    const double c = limited_concentration(at.x[molecule_density].value);
    return step.maturation_rate * at.delta_E * at.x[moment].value * step.matured.spontaneous_curvature(c).value;
}

void add_flow(const PointState& at, double r, double w, const StepNumbers& step, StepDiagnostics& diagnostics) {
    const auto &ur = at.x[velocity_r], &uz = at.x[velocity_z];
    const double nu = layer_viscosity(at.layer.phi, step.fluid, step.weight, step.numerics.viscosity_mean);
    const double hoop = ur.value / r, shear = ur.z + uz.r, divergence = ur.r + hoop + uz.z;
    const double stretching = surface_divergence(at.N.r, at.N.z, ur.r, hoop, uz.z, shear);
    diagnostics.viscous_dissipation += w * nu *
                                       (2 * (ur.r * ur.r + uz.z * uz.z + hoop * hoop) + shear * shear +
                                        step.divergence_penalty * divergence * divergence);
    diagnostics.tension_power += w * (at.delta_Gamma * at.x[tension].value * stretching -
                                      at.layer.delta * at.x[pressure_layer].value * divergence);
    if (step.fluid.dynamics != Dynamics::geometric) return;
    const double G = at.x[normal_force].value;
    diagnostics.mobility_dissipation += w * step.fluid.normal_mobility * G * G * delta_N(at.layer);
}

/// `rate` is ∂c/∂t, `bulk` c_b/c_∞.
void add_molecules(const PointState& at, double w, double rate, double bulk, const LayerEnergy& energy,
                   const StepNumbers& step, StepDiagnostics& diagnostics) {
    const auto& c = at.x[molecule_density];
    if (energy.coupled) {
        const double edge = energy.edge.density(at.elastic.curvature, c.value, at.along * at.along).value;
        const double driven = along_sheet(at.x[molecule_potential], at.N);
        diagnostics.line_energy += w * at.delta_E * edge;
        diagnostics.bending_energy -= w * at.delta_E * edge;
        diagnostics.molecule_dissipation += w * step.transport.mobility * at.delta_E * driven * driven;
    }
    if (!step.exchange.none()) {
        const double j = step.exchange.rate<double>(
            c.value, bending_by_concentration(energy, at.elastic.curvature, at.elastic.by_concentration, c.value),
            step.molecules, bulk);
        diagnostics.exchange_rate += w * at.delta_Gamma * j;
        diagnostics.exchange_power += w * at.delta_Gamma * j * at.e_c;
    }
    const double carried = at.x[velocity_r].value * c.r + at.x[velocity_z].value * c.z;
    diagnostics.transport_power += w * at.delta_Gamma * at.e_c * (rate + carried);
}

void raise(double& largest, double value) {
    largest = std::max(largest, value);
}

}  // namespace

SolutionMeasures measure_solution(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                                  const Vector& before, const Vector& predicted, const Vector& rate,
                                  const Vector& solution) {
    const dealii::QGauss<2> quadrature(gauss_points(step.numerics));
    std::vector<Wanted> wanted{{&space,
                                &solution,
                                {velocity_r, velocity_z, pressure_layer, tension, distance, normal_force, moment,
                                 molecule_density, molecule_potential, membrane_stretch}},
                               {&space, &before, {distance}},
                               {&space, &predicted, {distance}},
                               {&space, &rate, {molecule_density}}};
    if (step.supply) wanted.push_back({step.supply->space, &step.supply->values, {depletion_at_membrane}});
    SolutionMeasures out{};
    LayerIntegrals& integrals = out.integrals;
    StepDiagnostics& diagnostics = out.diagnostics;
    for_each_point(space, step, quadrature, wanted, [&](const CellPoint& point, const auto& x) {
        const PointState at(point, x[0], energy, step);
        const double w = point.measure, psi = at.x[distance].value, s = at.x[membrane_stretch].value;
        integrals.area += w * at.layer.delta;
        integrals.molecules += w * at.delta_Gamma * at.x[molecule_density].value;
        integrals.stretching += w * at.delta_Gamma * s;
        diagnostics.bending_energy += w * energy_per_volume(at, energy);
        diagnostics.maturation_power += w * maturation_power(at, step);
        add_flow(at, point.r, w, step, diagnostics);
        add_molecules(at, w, x[3][molecule_density].value, step.supply ? 1 - x[4][depletion_at_membrane].value : 1,
                      energy, step, diagnostics);
        if (std::abs(at.layer.phi) > layer_edge) return;
        const double thickness_error = std::abs(std::hypot(at.x[distance].r, at.x[distance].z) - 1);
        const double motion = std::abs(psi - x[1][distance].value);
        raise(diagnostics.area_strain_max, std::abs(s - 1));
        raise(diagnostics.profile_error_max, thickness_error);
        raise(diagnostics.motion_max, motion);
        raise(out.layer_motion, motion * step.numerics.epsilon / at.epsilon);
        raise(out.molecules_rate, std::abs(x[3][molecule_density].value));
        if (std::abs(at.layer.phi) >= layer_middle) return;
        raise(diagnostics.thickness_error_max, thickness_error);
        raise(out.step_difference, std::abs(psi - x[2][distance].value));
    });
    const MPI_Comm communicator = space.dofs.get_communicator();
    sum_over_processes({&integrals.area, &integrals.molecules, &integrals.stretching, &diagnostics.bending_energy,
                        &diagnostics.viscous_dissipation, &diagnostics.mobility_dissipation, &diagnostics.tension_power,
                        &diagnostics.transport_power, &diagnostics.line_energy, &diagnostics.molecule_dissipation,
                        &diagnostics.exchange_rate, &diagnostics.exchange_power, &diagnostics.maturation_power},
                       communicator);
    largest_of_processes(
        {&diagnostics.area_strain_max, &diagnostics.thickness_error_max, &diagnostics.profile_error_max,
         &diagnostics.motion_max, &out.step_difference, &out.layer_motion, &out.molecules_rate},
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
    std::vector<double> sums(solutions.size());
    for (std::size_t j = 0; j < solutions.size(); ++j)
        for_each_point(space, step, quadrature, {{&space, &solutions[j], {distance, molecule_density}}},
                       [&](const CellPoint& at, const auto& x) {
                           const auto layer = layer_profile(x[0][distance].value, at.thickness.value);
                           sums[j] += at.measure * delta_Gamma(layer, step.weight) * x[0][molecule_density].value;
                       });
    dealii::Utilities::MPI::sum(sums, space.dofs.get_communicator(), sums);
    return sums;
}

double layer_increment(const Space& space, const StepNumbers& step, const Vector& increment, const Vector& solution) {
    const dealii::QGauss<2> quadrature(space.degrees[distance] + 1);
    double largest = 0;
    for_each_point(space, step, quadrature, {{&space, &solution, {distance}}, {&space, &increment, {distance}}},
                   [&](const CellPoint& at, const auto& x) {
                       const double epsilon = at.thickness.value;
                       if (std::abs(equilibrium_profile(x[0][distance].value, epsilon)) <= layer_edge)
                           raise(largest, std::abs(x[1][distance].value) * step.numerics.epsilon / epsilon);
                   });
    return dealii::Utilities::MPI::max(largest, space.dofs.get_communicator());
}

Vector presence(const Space& space, const StepNumbers& step, const Vector& solution) {
    Vector out = space.vector();
    out = 1;
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (unsigned int field = 0; field < n_fields; ++field) {
        if (lives_in_fluid(field)) continue;
        for_each_point(space, step, nodes(space.degrees[field]), {{&space, &solution, {distance}}},
                       [&](const CellPoint& at, const auto& x) {
                           if (at.q == 0) at.cell->get_dof_indices(indices);
                           const auto unknown = indices[space.local[field][at.q]];
                           if (!space.owned.is_element(unknown)) return;
                           const double well = layer_profile(x[0][distance].value, at.thickness.value).well;
                           out(unknown) = kept_by_cut(well * well, hardly_present * hardly_present);
                       });
    }
    return out;
}

}  // namespace endoflow::phasefield::production
