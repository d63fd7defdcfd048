#pragma once

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace endoflow::phasefield {

using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
using Mesh = dealii::parallel::distributed::Triangulation<2>;

/// Boundary ids of the half plane 0 < r < R, 0 < z < H.
enum Boundary : dealii::types::boundary_id { axis = 0, side = 1, bottom = 2, top = 3 };

/// A vector-valued continuous Lagrange space whose every component is a scalar Q_k of its own degree.
struct Space {
    Space(const Mesh& mesh, const std::vector<unsigned int>& degrees);

    std::vector<unsigned int> degrees;
    dealii::FESystem<2> element;
    dealii::DoFHandler<2> dofs;
    dealii::IndexSet owned, relevant;
    dealii::AffineConstraints<double> constraints;    // hanging nodes and boundary values of increments (all zero)
    dealii::AffineConstraints<double> hanging_nodes;  // these alone
    /// local[component][i] = index within the cell of the component's i-th scalar shape function
    std::vector<std::vector<unsigned int>> local;

    /// Numbers the unknowns on the present mesh; the constraints hold the hanging nodes and are left open.
    void distribute();
    /// A zero vector with the ghost values of the locally relevant unknowns.
    [[nodiscard]] Vector vector() const;
};

/// Calls visit(boundary id, component, global index, z of the support point) for every unknown on a boundary face of
/// the known cells.
template <class Visit>
void for_boundary_unknowns(const Space& space, const Visit& visit) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (cell->is_artificial() || !cell->at_boundary()) continue;
        cell->get_dof_indices(indices);
        const auto extent = cell->vertex(3) - cell->vertex(0);
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary()) continue;
            for (unsigned int i = 0; i < indices.size(); ++i)
                if (space.element.has_support_on_face(i, face)) {
                    const auto unit = space.element.unit_support_point(i);
                    visit(cell->face(face)->boundary_id(), space.element.system_to_component_index(i).first, indices[i],
                          cell->vertex(0)[1] + unit[1] * extent[1]);
                }
        }
    }
}

/// Fixes all unknowns of these components.
void switch_off(Space& space, const std::vector<unsigned int>& components);

/// Sets the owned unknowns of a component to a function of (r, z) at their support points.
template <class Function>
void interpolate(const Space& space, unsigned int component, const Function& function, Vector& vector) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        cell->get_dof_indices(indices);
        const auto origin = cell->vertex(0);
        const auto extent = cell->vertex(3) - origin;
        for (const unsigned int i : space.local[component]) {
            const auto x = space.element.unit_support_point(i);
            if (space.owned.is_element(indices[i]))
                vector(indices[i]) = function(origin[0] + x[0] * extent[0], origin[1] + x[1] * extent[1]);
        }
    }
}

/// After the last interpolate(): hanging nodes and ghost values.
void finish_interpolation(const Space& space, Vector& vector);

/// Multiplies the owned unknowns of one component; updates the ghost values.
void scale_component(const Space& space, unsigned int component, double factor, Vector& vector);

/// Σ_j weights[j] vectors[j], with ghost values; of the first vectors where there are more than weights.
[[nodiscard]] Vector combination(const Space& space, const std::vector<double>& weights,
                                 const std::vector<Vector>& vectors);

/// Coefficients of one component on one cell, from a ghosted vector's values on that cell.
void component_values(const Space& space, unsigned int component, const dealii::Vector<double>& cell_values,
                      std::vector<double>& out);

}  // namespace endoflow::phasefield
