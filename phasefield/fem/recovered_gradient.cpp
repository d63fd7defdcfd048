#include "phasefield/fem/recovered_gradient.h"

#include "phasefield/fem/same_cell.h"
#include "phasefield/fem/scalar_basis.h"

namespace endoflow::phasefield {

Vector recover_gradient(const Space& space, unsigned int component, const Vector& field, const Space& gradient_space) {
    const unsigned int degree = gradient_space.degrees[0];
    const ScalarBasis basis(space.degrees[component], nodes(degree));
    Vector gradient = gradient_space.vector(), count = gradient_space.vector();
    dealii::Vector<double> values(space.element.n_dofs_per_cell());
    std::vector<dealii::types::global_dof_index> indices(gradient_space.element.n_dofs_per_cell());
    std::vector<double> coefficients;
    ScalarField at_nodes;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        cell->get_dof_values(field, values);
        component_values(space, component, values, coefficients);
        evaluate(basis, box, coefficients, Derivatives::first, at_nodes);
        same_cell(cell, gradient_space)->get_dof_indices(indices);
        for (unsigned int node = 0; node < basis.n_points; ++node) {
            const auto r_index = indices[gradient_space.local[0][node]],
                       z_index = indices[gradient_space.local[1][node]];
            const double r =
                box.r0 + gradient_space.element.unit_support_point(gradient_space.local[0][node])[0] * box.hr;
            gradient(r_index) += r > 1e-9 * box.hr ? at_nodes.r[node] : 0.0;
            gradient(z_index) += at_nodes.z[node];
            count(r_index) += 1;
            count(z_index) += 1;
        }
    }
    gradient.compress(dealii::VectorOperation::add);
    count.compress(dealii::VectorOperation::add);
    for (unsigned int i = 0; i < gradient.locally_owned_size(); ++i)
        if (count.local_element(i) > 0) gradient.local_element(i) /= count.local_element(i);
    gradient_space.hanging_nodes.distribute(gradient);
    gradient.update_ghost_values();
    return gradient;
}

}  // namespace endoflow::phasefield
