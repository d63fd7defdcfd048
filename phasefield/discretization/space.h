#pragma once

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
using Mesh = dealii::parallel::distributed::Triangulation<2>;

/// Boundary ids of the half plane 0 < r < R, 0 < z < H.
enum Boundary : dealii::types::boundary_id { axis = 0, side = 1, bottom = 2, top = 3 };

/// Components of the coupled system of Sec. 3, step 1. `moment` is β f.
enum FlowComponent : unsigned int { u_r = 0, u_z = 1, pressure = 2, tension = 3, phi = 4, force = 5, moment = 6 };
inline constexpr unsigned int n_flow_components = 7;

/// Components of the molecules' system (40)-(41).
enum MoleculeComponent : unsigned int { concentration = 0, potential = 1 };

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

/// Degrees of the coupled system's components in the order of FlowComponent.
std::vector<unsigned int> flow_degrees(const PhaseFieldParameters& parameters);

/// Closes the constraints of the coupled system (values of the increments):
/// u_r = 0 on the axis; u_z = 0 on r = R for |z − z₀| ≤ δ; λ = 0 on the outer boundary; φ fixed on r = R, whose test
/// function belongs to the g row. Without flow (geometric dynamics) u, p and λ are switched off; without
/// inextensibility λ is.
void close_flow_constraints(Space& space, const Parameters& parameters);

/// Coefficients of one component on one cell, from a ghosted vector's values on that cell.
void component_values(const Space& space, unsigned int component, const dealii::Vector<double>& cell_values,
                      std::vector<double>& out);

}  // namespace endoflow::phasefield
