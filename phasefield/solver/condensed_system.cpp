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

template <class Real>
dealii::LAPACKFullMatrix<Real> rounded(const dealii::LAPACKFullMatrix<double>& from) {
    dealii::LAPACKFullMatrix<Real> out(from.m(), from.n());
    for (unsigned int k = 0; k < from.n(); ++k)
        for (unsigned int i = 0; i < from.m(); ++i) out(i, k) = static_cast<Real>(from(i, k));
    return out;
}

}  // namespace

CondensedSystem::CondensedSystem(MPI_Comm communicator, std::string name, std::vector<unsigned int> components)
    : communicator_(communicator),
      name_(std::move(name)),
      components_(std::move(components)),
      numbers_(std::in_place_type<Numbers<float>>, communicator, name_) {}

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
    std::vector<Index> all(space.element.n_dofs_per_cell()), indices(in_cell_.size()), outer(n_outer_);
    std::vector<std::vector<Index>> outer_unknowns;
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
        Place& kept = cells_.emplace_back();
        kept.unknowns = indices;
        for (unsigned int i = 0; i < n_inner_; ++i)
            if (space.constraints.is_constrained(indices[n_outer_ + i])) kept.fixed.push_back(i);
        outer_unknowns.push_back(outer);
    }
    constraints.close();
    free_unknowns_.clear();
    for (std::size_t k = 0; k < cells_.size(); ++k)
        free_unknowns_.push_back(express_by_free(outer_unknowns[k], constraints, cells_[k].parts));
    process_ = process;
    owned_ = dofs.locally_owned_dofs();
    inverse_.reinit(n_inner_, n_inner_);
    to_inner_.reinit(n_inner_, n_outer_);
    from_inner_.reinit(n_outer_, n_inner_);
    A_oi_.reinit(n_outer_, n_inner_);
    S_.reinit(n_outer_, n_outer_);
    outer_solution_.reinit(n_outer_);
    allocate<float>();
}

template <class Real>
void CondensedSystem::allocate() {
    auto& numbers = numbers_.emplace<Numbers<Real>>(communicator_, name_);
    numbers.system.reinit(free_unknowns_, process_, owned_);
    numbers.cells.resize(cells_.size());
    for (auto& cell : numbers.cells) cell.residual.reinit(n_inner_);
    numbers.outer.reinit(n_outer_);
    numbers.inner.reinit(n_inner_);
}

void CondensedSystem::use(Precision wanted) {
    if (wanted == precision()) return;
    wanted == Precision::single ? allocate<float>() : allocate<double>();
}

Precision CondensedSystem::precision() const {
    return std::holds_alternative<Numbers<float>>(numbers_) ? Precision::single : Precision::full;
}

void CondensedSystem::forget_factors() {
    std::visit([](auto& numbers) { numbers.system.forget_factors(); }, numbers_);
}

bool CondensedSystem::has_factors() const {
    return std::visit([](const auto& numbers) { return numbers.system.has_factors(); }, numbers_);
}

double CondensedSystem::operations() const {
    return std::visit([](const auto& numbers) { return numbers.system.operations(); }, numbers_);
}

CondensedSystem::Index CondensedSystem::shared_unknowns() const {
    return std::visit([](const auto& numbers) { return numbers.system.shared_unknowns(); }, numbers_);
}

std::vector<CondensedSystem::Index> CondensedSystem::express_by_free(
    const std::vector<Index>& unknowns, const dealii::AffineConstraints<double>& constraints,
    std::vector<Part>& parts) {
    std::vector<Index> out;
    const auto add = [&](unsigned int outer, Index free, double weight) {
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

template <class Real>
void CondensedSystem::eliminate(const dealii::FullMatrix<double>& matrix, const Place& place,
                                typename Numbers<Real>::Elimination& cell) {
    const unsigned int m = n_outer_, n = n_inner_;
    const auto A = [&](unsigned int i, unsigned int k) { return matrix(in_cell_[i], in_cell_[k]); };
    Dense A_ii(n, n);
    for (unsigned int i = 0; i < n; ++i) {
        // The rows' sizes differ by many powers of ten away from the membrane, and pivoting compares them.
        double largest = 0;
        for (unsigned int k = 0; k < n; ++k) largest = std::max(largest, std::abs(A(m + i, m + k)));
        const bool fixed = std::binary_search(place.fixed.begin(), place.fixed.end(), i);
        const double scale = fixed || largest == 0 ? 1 : 1 / largest;
        for (unsigned int k = 0; k < n; ++k) A_ii(i, k) = fixed ? static_cast<double>(i == k) : scale * A(m + i, m + k);
        for (unsigned int k = 0; k < m; ++k) to_inner_(i, k) = fixed ? 0 : -scale * A(m + i, k);
        for (unsigned int k = 0; k < n; ++k) inverse_(i, k) = i == k ? scale : 0;
        for (unsigned int k = 0; k < m; ++k) A_oi_(k, i) = A(k, m + i);
    }
    cell.undetermined = false;
    try {
        A_ii.compute_lu_factorization();
        A_ii.solve(to_inner_);
        A_ii.solve(inverse_);
    } catch (const dealii::LACExceptions::ExcSingular&) {
        cell.undetermined = true;
        to_inner_ = 0;
        inverse_ = 0;
    }
    A_oi_.mmult(from_inner_, inverse_);
    from_inner_ *= -1;
    for (unsigned int i = 0; i < m; ++i)
        for (unsigned int k = 0; k < m; ++k) S_(i, k) = A(i, k);
    A_oi_.mmult(S_, to_inner_, true);
    cell.inverse = rounded<Real>(inverse_);
    cell.to_inner = rounded<Real>(to_inner_);
    cell.from_inner = rounded<Real>(from_inner_);
}

void CondensedSystem::set(const Cell& cell, const dealii::FullMatrix<double>& matrix) {
    const std::size_t own = position(cell);
    const Place& place = cells_[own];
    std::visit(
        [&]<class Real>(Numbers<Real>& numbers) {
            eliminate<Real>(matrix, place, numbers.cells[own]);
            const std::size_t n = numbers.system.unknowns(own);
            Real* matrix_of_free = numbers.system.matrix(own);
            std::fill(matrix_of_free, matrix_of_free + n * n, Real{0});
            for (const Part& column : place.parts)
                for (const Part& row : place.parts)
                    matrix_of_free[column.free * n + row.free] +=
                        static_cast<Real>(row.weight * S_(row.outer, column.outer) * column.weight);
        },
        numbers_);
}

void CondensedSystem::set(const Cell& cell, const dealii::Vector<double>& right_hand_side) {
    const std::size_t own = position(cell);
    const Place& place = cells_[own];
    std::visit(
        [&]<class Real>(Numbers<Real>& numbers) {
            auto& kept = numbers.cells[own];
            for (unsigned int i = 0; i < n_inner_; ++i)
                kept.residual(i) = static_cast<Real>(right_hand_side(in_cell_[n_outer_ + i]));
            for (const unsigned int i : place.fixed) kept.residual(i) = 0;
            kept.from_inner.vmult(numbers.outer, kept.residual);
            free_residual_.reinit(numbers.system.unknowns(own));
            for (const Part& part : place.parts)
                free_residual_(part.free) += part.weight * (right_hand_side(in_cell_[part.outer]) +
                                                            static_cast<double>(numbers.outer(part.outer)));
            numbers.system.set(own, free_residual_);
        },
        numbers_);
}

void CondensedSystem::solve(const Space& space, Vector& solution) {
    std::visit(
        [&](auto& numbers) {
            const bool undetermined = std::any_of(numbers.cells.begin(), numbers.cells.end(),
                                                  [](const auto& cell) { return cell.undetermined; });
            if (dealii::Utilities::MPI::max(undetermined ? 1 : 0, communicator_) == 1)
                throw SolverError("linear-solver",
                                  "the unknowns inside of a cell of the " + name_ + " system are undetermined",
                                  "use a smaller time.max_step or phase_field.cell_size");
            numbers.system.solve();
        },
        numbers_);
    expand(space, solution);
}

void CondensedSystem::apply_factors(const Space& space, Vector& solution) {
    std::visit([](auto& numbers) { numbers.system.apply_factors(); }, numbers_);
    expand(space, solution);
}

void CondensedSystem::expand(const Space& space, Vector& solution) {
    solution.zero_out_ghost_values();
    std::visit(
        [&]<class Real>(Numbers<Real>& numbers) {
            for (std::size_t own = 0; own < cells_.size(); ++own) {
                const Place& place = cells_[own];
                auto& kept = numbers.cells[own];
                outer_solution_ = 0;
                for (const Part& part : place.parts)
                    outer_solution_(part.outer) += part.weight * numbers.system.values(own)[part.free];
                numbers.outer = outer_solution_;
                kept.inverse.vmult(numbers.inner, kept.residual);
                kept.to_inner.vmult_add(numbers.inner, numbers.outer);
                for (unsigned int i = 0; i < n_outer_; ++i)
                    if (space.owned.is_element(place.unknowns[i])) solution(place.unknowns[i]) = outer_solution_(i);
                for (unsigned int i = 0; i < n_inner_; ++i)
                    solution(place.unknowns[n_outer_ + i]) = static_cast<double>(numbers.inner(i));
            }
        },
        numbers_);
    solution.update_ghost_values();
}

}  // namespace endoflow::phasefield
