#include "phasefield/schemes/paper/coupled_step.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

#include "phasefield/fem/recovered_gradient.h"
#include "phasefield/fem/same_cell.h"

namespace endoflow::phasefield::paper {

namespace {

std::vector<unsigned int> copies(int degree, std::size_t count) {
    return std::vector<unsigned int>(count, static_cast<unsigned int>(degree));
}

}  // namespace

Spaces::Spaces(const Mesh& mesh, const Parameters& p)
    : flow(mesh, flow_degrees(p.phase_field)),
      molecules(mesh, copies(p.phase_field.surface_degree, 2)),
      stretching(mesh, copies(p.phase_field.surface_degree, 1)),
      gradient(mesh, copies(p.phase_field.degree, 2)) {}

void Spaces::distribute(const Parameters& parameters) {
    flow.distribute();
    close_flow_constraints(flow, parameters);
    for (Space* space : {&molecules, &stretching, &gradient}) {
        space->distribute();
        space->constraints.close();
    }
}

unsigned int quadrature_points(const PhaseFieldParameters& p) {
    return static_cast<unsigned int>(std::max({p.degree, p.velocity_degree, p.surface_degree})) + 2;
}

void take_over(State& state, State other) {
    state.flow.swap(other.flow);
    state.molecules.swap(other.molecules);
    state.stretching.swap(other.stretching);
    for (const Vector* vector : {&state.flow, &state.molecules, &state.stretching}) vector->update_ghost_values();
}

OldFields::OldFields(const Spaces& spaces, const Parameters& parameters, const dealii::Quadrature<2>& quadrature)
    : spaces_(&spaces),
      parameters_(parameters),
      model_(parameters.membrane),
      quadrature_(quadrature),
      molecule_basis_(spaces.molecules.degrees[0], quadrature),
      stretching_basis_(spaces.stretching.degrees[0], quadrature),
      flow_values_(spaces.flow.element.n_dofs_per_cell()),
      molecule_values_(spaces.molecules.element.n_dofs_per_cell()),
      stretching_values_(spaces.stretching.element.n_dofs_per_cell()),
      gradient_values_(spaces.gradient.element.n_dofs_per_cell()) {
    for (const unsigned int component : {u_r, u_z, phi, moment})
        flow_bases_.push_back(std::make_shared<const ScalarBasis>(spaces.flow.degrees[component], quadrature));
}

void OldFields::evaluate_cell(const dealii::DoFHandler<2>::active_cell_iterator& cell, const State& state,
                              CoupledPoints& points) {
    const CellBox box = cell_box(cell);
    same_cell(cell, spaces_->flow)->get_dof_values(state.flow, flow_values_);
    same_cell(cell, spaces_->molecules)->get_dof_values(state.molecules, molecule_values_);
    same_cell(cell, spaces_->stretching)->get_dof_values(state.stretching, stretching_values_);

    const auto flow_field = [&](unsigned int basis, unsigned int component, Derivatives order, ScalarField& field) {
        component_values(spaces_->flow, component, flow_values_, coefficients_);
        evaluate(*flow_bases_[basis], box, coefficients_, order, field);
    };
    flow_field(0, u_r, Derivatives::first, u_r_);
    flow_field(1, u_z, Derivatives::first, u_z_);
    flow_field(2, phi, Derivatives::second, phi_);
    flow_field(3, moment, Derivatives::first, moment_);
    component_values(spaces_->molecules, concentration, molecule_values_, coefficients_);
    evaluate(molecule_basis_, box, coefficients_, Derivatives::first, concentration_);
    component_values(spaces_->stretching, 0, stretching_values_, coefficients_);
    evaluate(stretching_basis_, box, coefficients_, Derivatives::first, stretching_);

    const auto& numerics = parameters_.phase_field;
    points.resize(quadrature_.size());
    for (unsigned int q = 0; q < quadrature_.size(); ++q) {
        CoupledPoint& p = points[q];
        p.r = box.r0 + box.hr * quadrature_.point(q)[0];
        p.measure = quadrature_.weight(q) * box.hr * box.hz * p.r;
        p.phi = {phi_.value[q], phi_.r[q], phi_.z[q], phi_.rr[q], phi_.rz[q], phi_.zz[q]};
        p.layer = layer_geometry(phi_.r[q], phi_.z[q], numerics.epsilon);
        p.relaxation = {};
        p.viscosity = viscosity(p.phi.value, parameters_.fluid, numerics.viscosity_mean);
        p.velocity_r = u_r_.value[q];
        p.velocity_z = u_z_.value[q];
        p.c_r = concentration_.r[q];
        p.c_z = concentration_.z[q];
        p.bending = bending_coefficients(model_, concentration_.value[q]);
        const bool is_f = numerics.paper.bending_unknown == BendingUnknown::f;
        const bool clipped = clip_concentration(concentration_.value[q]) != concentration_.value[q];
        const double slope = is_f && !clipped ? p.bending.stiffness_c : 0;
        p.moment_per_unknown = is_f ? p.bending.stiffness : 1;
        p.per_unknown_r = slope * p.c_r;
        p.per_unknown_z = slope * p.c_z;
        p.moment = p.moment_per_unknown * moment_.value[q];
        p.stretching = stretching_.value[q];
    }
    if (gradient_ != nullptr) evaluate_relaxation(cell, points);
}

void OldFields::evaluate_relaxation(const dealii::DoFHandler<2>::active_cell_iterator& cell, CoupledPoints& points) {
    const CellBox box = cell_box(cell);
    same_cell(cell, spaces_->gradient)->get_dof_values(*gradient_, gradient_values_);
    component_values(spaces_->gradient, 0, gradient_values_, coefficients_);
    evaluate(*flow_bases_[2], box, coefficients_, Derivatives::first, gradient_r_);
    component_values(spaces_->gradient, 1, gradient_values_, coefficients_);
    evaluate(*flow_bases_[2], box, coefficients_, Derivatives::first, gradient_z_);
    for (std::size_t q = 0; q < points.size(); ++q) {
        CoupledPoint& p = points[q];
        const LevelSetPoint recovered{p.phi.value,
                                      gradient_r_.value[q],
                                      gradient_z_.value[q],
                                      gradient_r_.r[q],
                                      0.5 * (gradient_r_.z[q] + gradient_z_.r[q]),
                                      gradient_z_.z[q]};
        p.relaxation = profile_relaxation(recovered, p.r, parameters_.domain.radius, parameters_.phase_field.epsilon);
    }
}

Couplings flow_couplings(const Parameters& p) {
    Couplings table(n_flow_components, n_flow_components);
    table.fill(dealii::DoFTools::none);
    const auto couple = [&table](unsigned int i, unsigned int k) {
        table(i, k) = table(k, i) = dealii::DoFTools::always;
    };
    for (unsigned int i = 0; i < n_flow_components; ++i) couple(i, i);
    couple(u_r, u_z);
    for (const unsigned int velocity : {u_r, u_z})
        for (const unsigned int other : {pressure, tension, force}) couple(velocity, other);
    couple(phi, force);
    couple(phi, moment);
    if (p.phase_field.paper.force_centering > 0)
        for (const unsigned int velocity : {u_r, u_z})
            table(velocity, phi) = table(velocity, moment) = dealii::DoFTools::always;
    return table;
}

void assemble_coupled(const Spaces& spaces, const State& old_state, const Vector& iterate, const Parameters& parameters,
                      double tau, LinearSystem& system) {
    const dealii::QGauss<2> quadrature(quadrature_points(parameters.phase_field));
    const StepCoefficients step{tau, parameters.phase_field, parameters.fluid};
    OldFields old_fields(spaces, parameters, quadrature);
    Vector recovered_gradient;
    if (parameters.phase_field.paper.profile_mobility > 0) {
        recovered_gradient = recover_gradient(spaces.flow, phi, old_state.flow, spaces.gradient);
        old_fields.with_relaxation(recovered_gradient);
    }
    LocalSystem local(spaces.flow, quadrature);
    const unsigned int n = spaces.flow.element.n_dofs_per_cell();
    dealii::FullMatrix<double> cell_matrix(n, n);
    dealii::Vector<double> cell_rhs(n), cell_iterate(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    CoupledPoints points;

    system.start();
    for (const auto& cell : spaces.flow.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        cell->get_dof_values(iterate, cell_iterate);
        cell->get_dof_indices(indices);
        old_fields.evaluate_cell(cell, old_state, points);
        local.start(cell_box(cell), cell_iterate);
        add_flow_terms(points, step, local);
        add_willmore_terms(points, step, local);
        local.write(cell_matrix, cell_rhs);
        spaces.flow.constraints.distribute_local_to_global(cell_matrix, cell_rhs, indices, system.matrix,
                                                           system.right_hand_side);
    }
}

}  // namespace endoflow::phasefield::paper
