#include "phasefield/solver/condensed_system.h"

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_trace.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/same_cell.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// These components of the space's element without the unknowns inside of the cell. Those on vertices and faces come
/// first in both, in the same order.
dealii::FESystem<2> face_element(const Space& space, const std::vector<unsigned int>& components) {
    std::vector<std::shared_ptr<dealii::FE_TraceQ<2>>> elements;
    std::vector<const dealii::FiniteElement<2>*> addresses;
    for (const unsigned int component : components)
        addresses.push_back(
            elements.emplace_back(std::make_shared<dealii::FE_TraceQ<2>>(space.degrees[component])).get());
    return {addresses, std::vector<unsigned int>(components.size(), 1)};
}

}  // namespace

CondensedSystem::CondensedSystem(MPI_Comm communicator, std::string name, std::vector<unsigned int> components)
    : name_(std::move(name)), components_(std::move(components)), system_(communicator, name_) {}

void CondensedSystem::reinit(const Space& space, const std::vector<unsigned int>& process) {
    const auto& mesh = space.dofs.get_triangulation();
    const auto element = face_element(space, components_);
    dealii::DoFHandler<2> dofs(mesh);
    dofs.distribute_dofs(element);
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    dealii::AffineConstraints<double> constraints(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);

    in_cell_.clear();
    for (const unsigned int component : components_)
        in_cell_.insert(in_cell_.end(), space.local[component].begin(), space.local[component].end());
    std::sort(in_cell_.begin(), in_cell_.end());
    n_outer_ = element.n_dofs_per_cell();
    n_inner_ = static_cast<unsigned int>(in_cell_.size()) - n_outer_;
    cells_.clear();
    positions_.assign(mesh.n_active_cells(), 0);
    std::vector<SubdomainSystem::Index> all(space.element.n_dofs_per_cell()), indices(in_cell_.size()), outer(n_outer_);
    std::vector<std::vector<SubdomainSystem::Index>> outer_unknowns, free_unknowns;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (cell->is_artificial()) continue;
        cell->get_dof_indices(all);
        for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = all[in_cell_[i]];
        same_cell(cell, dofs)->get_dof_indices(outer);
        for (unsigned int i = 0; i < n_outer_; ++i)
            if (space.constraints.is_constrained(indices[i]) && !constraints.is_constrained(outer[i]))
                constraints.add_line(outer[i]);
        if (!cell->is_locally_owned()) continue;
        positions_[cell->active_cell_index()] = cells_.size();
        Elimination& kept = cells_.emplace_back();
        kept.unknowns = indices;
        for (unsigned int i = 0; i < n_inner_; ++i)
            if (space.constraints.is_constrained(indices[n_outer_ + i])) kept.fixed.push_back(i);
        kept.residual.reinit(n_inner_);
        outer_unknowns.push_back(outer);
    }
    constraints.close();
    for (std::size_t k = 0; k < cells_.size(); ++k)
        free_unknowns.push_back(express_by_free(outer_unknowns[k], constraints, cells_[k].parts));
    system_.reinit(free_unknowns, process, dofs.locally_owned_dofs());

    inner_rows_.reinit(n_inner_, n_outer_ + n_inner_);
    A_oi_.reinit(n_outer_, n_inner_);
    S_.reinit(n_outer_, n_outer_);
    outer_residual_.reinit(n_outer_);
    outer_solution_.reinit(n_outer_);
    inner_solution_.reinit(n_inner_);
}

std::vector<SubdomainSystem::Index> CondensedSystem::express_by_free(
    const std::vector<SubdomainSystem::Index>& unknowns, const dealii::AffineConstraints<double>& constraints,
    std::vector<Part>& parts) {
    std::vector<SubdomainSystem::Index> out;
    const auto add = [&](unsigned int outer, SubdomainSystem::Index free, double weight) {
        const auto known = std::find(out.begin(), out.end(), free);
        parts.push_back({outer, static_cast<unsigned int>(known - out.begin()), weight});
        if (known == out.end()) out.push_back(free);
    };
    for (unsigned int i = 0; i < unknowns.size(); ++i) {
        if (!constraints.is_constrained(unknowns[i]))
            add(i, unknowns[i], 1);
        else
            for (const auto& [free, weight] : *constraints.get_constraint_entries(unknowns[i])) add(i, free, weight);
    }
    return out;
}

void CondensedSystem::eliminate(const dealii::FullMatrix<double>& matrix, Elimination& cell) {
    const unsigned int m = n_outer_, n = n_inner_;
    const auto A = [&](unsigned int i, unsigned int k) { return matrix(in_cell_[i], in_cell_[k]); };
    Dense A_ii(n, n);
    for (unsigned int i = 0; i < n; ++i) {
        // The rows' sizes differ by many powers of ten away from the membrane, and pivoting compares them.
        double largest = 0;
        for (unsigned int k = 0; k < n; ++k) largest = std::max(largest, std::abs(A(m + i, m + k)));
        const bool fixed = std::binary_search(cell.fixed.begin(), cell.fixed.end(), i);
        const double scale = fixed || largest == 0 ? 1 : 1 / largest;
        for (unsigned int k = 0; k < n; ++k) A_ii(i, k) = fixed ? static_cast<double>(i == k) : scale * A(m + i, m + k);
        for (unsigned int k = 0; k < m; ++k) inner_rows_(i, k) = fixed ? 0 : -scale * A(m + i, k);
        for (unsigned int k = 0; k < n; ++k) inner_rows_(i, m + k) = i == k ? scale : 0;
        for (unsigned int k = 0; k < m; ++k) A_oi_(k, i) = A(k, m + i);
    }
    cell.undetermined = false;
    try {
        A_ii.compute_lu_factorization();
        A_ii.solve(inner_rows_);
    } catch (const dealii::LACExceptions::ExcSingular&) {
        cell.undetermined = true;
        inner_rows_ = 0;
    }
    cell.to_inner.reinit(n, m);
    cell.inverse.reinit(n, n);
    cell.from_inner.reinit(m, n);
    for (unsigned int i = 0; i < n; ++i) {
        for (unsigned int k = 0; k < m; ++k) cell.to_inner(i, k) = inner_rows_(i, k);
        for (unsigned int k = 0; k < n; ++k) cell.inverse(i, k) = inner_rows_(i, m + k);
    }
    A_oi_.mmult(cell.from_inner, cell.inverse);
    cell.from_inner *= -1;
    for (unsigned int i = 0; i < m; ++i)
        for (unsigned int k = 0; k < m; ++k) S_(i, k) = A(i, k);
    A_oi_.mmult(S_, cell.to_inner, true);
}

void CondensedSystem::condense(const dealii::Vector<double>& right_hand_side, Elimination& cell) {
    for (unsigned int i = 0; i < n_inner_; ++i) cell.residual(i) = right_hand_side(in_cell_[n_outer_ + i]);
    for (const unsigned int i : cell.fixed) cell.residual(i) = 0;
    for (unsigned int i = 0; i < n_outer_; ++i) outer_residual_(i) = right_hand_side(in_cell_[i]);
    cell.from_inner.vmult_add(outer_residual_, cell.residual);
}

void CondensedSystem::set(const Cell& cell, const dealii::FullMatrix<double>& matrix) {
    const std::size_t own = position(cell);
    Elimination& kept = cells_[own];
    eliminate(matrix, kept);
    free_matrix_.reinit(system_.unknowns(own), system_.unknowns(own));
    for (const Part& row : kept.parts)
        for (const Part& column : kept.parts)
            free_matrix_(row.free, column.free) += row.weight * S_(row.outer, column.outer) * column.weight;
    system_.set(own, free_matrix_);
}

void CondensedSystem::set(const Cell& cell, const dealii::Vector<double>& right_hand_side) {
    const std::size_t own = position(cell);
    Elimination& kept = cells_[own];
    condense(right_hand_side, kept);
    free_residual_.reinit(system_.unknowns(own));
    for (const Part& part : kept.parts) free_residual_(part.free) += part.weight * outer_residual_(part.outer);
    system_.set(own, free_residual_);
}

void CondensedSystem::solve(const Space& space, Vector& solution) {
    const bool undetermined =
        std::any_of(cells_.begin(), cells_.end(), [](const Elimination& cell) { return cell.undetermined; });
    if (dealii::Utilities::MPI::max(undetermined ? 1 : 0, space.dofs.get_communicator()) == 1)
        throw SolverError("linear-solver", "the unknowns inside of a cell of the " + name_ + " system are undetermined",
                          "use a smaller time.max_step or phase_field.cell_size");
    system_.solve();
    expand(space, solution);
}

void CondensedSystem::apply_factors(const Space& space, Vector& solution) {
    system_.apply_factors();
    expand(space, solution);
}

void CondensedSystem::expand(const Space& space, Vector& solution) {
    solution.zero_out_ghost_values();
    for (std::size_t position = 0; position < cells_.size(); ++position) {
        const Elimination& cell = cells_[position];
        outer_solution_ = 0;
        for (const Part& part : cell.parts)
            outer_solution_(part.outer) += part.weight * system_.values(position)[part.free];
        cell.inverse.vmult(inner_solution_, cell.residual);
        cell.to_inner.vmult_add(inner_solution_, outer_solution_);
        for (unsigned int i = 0; i < n_outer_; ++i)
            if (space.owned.is_element(cell.unknowns[i])) solution(cell.unknowns[i]) = outer_solution_(i);
        for (unsigned int i = 0; i < n_inner_; ++i) solution(cell.unknowns[n_outer_ + i]) = inner_solution_(i);
    }
    solution.update_ghost_values();
}

}  // namespace endoflow::phasefield
