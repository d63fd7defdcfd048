#include "phasefield/schemes/paper/layer_fields.h"

#include <deal.II/base/quadrature_lib.h>

#include "phasefield/fem/same_cell.h"
#include "phasefield/schemes/paper/surface_transport.h"

namespace endoflow::phasefield::paper {

double layer_weight(double gradient, double epsilon) {
    return std::hypot(gradient, 1e-8 / epsilon);
}

LayerFields::LayerFields(const Spaces& spaces, const Space& surface, const Parameters& parameters,
                         const dealii::Quadrature<2>& quadrature)
    : spaces_(&spaces),
      surface_(&surface),
      epsilon_(parameters.phase_field.epsilon),
      quadrature_(quadrature),
      velocity_basis_(spaces.flow.degrees[u_r], quadrature),
      phi_basis_(spaces.flow.degrees[phi], quadrature),
      surface_basis_(surface.degrees[0], quadrature),
      old_values_(spaces.flow.element.n_dofs_per_cell()),
      new_values_(spaces.flow.element.n_dofs_per_cell()) {}

void LayerFields::evaluate_cell(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell, const CellBox& box,
                                const Vector& flow_old, const Vector& flow_new,
                                const dealii::Vector<double>& surface_values, std::vector<LayerPoint>& points) {
    flow_cell->get_dof_values(flow_old, old_values_);
    flow_cell->get_dof_values(flow_new, new_values_);
    const auto field = [&](const Space& space, const ScalarBasis& basis, unsigned int component,
                           const dealii::Vector<double>& values, ScalarField& out) {
        component_values(space, component, values, coefficients_);
        evaluate(basis, box, coefficients_, Derivatives::first, out);
    };
    field(spaces_->flow, phi_basis_, phi, old_values_, phi_old_);
    field(spaces_->flow, phi_basis_, phi, new_values_, phi_new_);
    field(spaces_->flow, velocity_basis_, u_r, new_values_, u_r_);
    field(spaces_->flow, velocity_basis_, u_z, new_values_, u_z_);
    field(*surface_, surface_basis_, 0, surface_values, surface_field_);
    points.resize(quadrature_.size());
    for (unsigned int q = 0; q < quadrature_.size(); ++q) {
        LayerPoint& p = points[q];
        p.r = box.r0 + box.hr * quadrature_.point(q)[0];
        p.measure = quadrature_.weight(q) * box.hr * box.hz * p.r;
        p.weight_old = layer_weight(std::hypot(phi_old_.r[q], phi_old_.z[q]), epsilon_);
        p.layer = layer_geometry(phi_new_.r[q], phi_new_.z[q], epsilon_);
        p.weight = layer_weight(p.layer.gradient, epsilon_);
        p.velocity_r = u_r_.value[q];
        p.velocity_z = u_z_.value[q];
        p.value_old = surface_field_.value[q];
    }
}

void advance_on_layer(const Spaces& spaces, const Space& surface, const Vector& flow_old, const Vector& flow_new,
                      const Parameters& parameters, const SurfaceTerms& add_terms, const SurfaceInflow& add_inflow,
                      LinearSystem& system, Vector& values) {
    const dealii::QGauss<2> quadrature(quadrature_points(parameters.phase_field));
    LayerFields layer(spaces, surface, parameters, quadrature);
    LocalSystem local(surface, quadrature);
    const unsigned int n = surface.element.n_dofs_per_cell();
    dealii::FullMatrix<double> cell_matrix(n, n);
    dealii::Vector<double> cell_rhs(n), cell_values(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    std::vector<LayerPoint> points;

    system.start();
    for (const auto& cell : surface.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const auto flow_cell = same_cell(cell, spaces.flow);
        const CellBox box = cell_box(cell);
        cell->get_dof_values(values, cell_values);
        cell->get_dof_indices(indices);
        layer.evaluate_cell(flow_cell, box, flow_old, flow_new, cell_values, points);
        local.start(box, cell_values);
        add_terms(points, local);
        local.write(cell_matrix, cell_rhs);
        if (cell->at_boundary()) add_inflow(flow_cell, box, cell_rhs);
        surface.constraints.distribute_local_to_global(cell_matrix, cell_rhs, indices, system.matrix,
                                                       system.right_hand_side);
    }
    Vector increment = surface.vector();
    system.solve(surface.constraints, increment);
    values += increment;
    values.update_ghost_values();
}

}  // namespace endoflow::phasefield::paper
