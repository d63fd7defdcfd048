#include "phasefield/solver/subdomain_system.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/support/error.h"

namespace endoflow::phasefield {

template <class Real>
SubdomainSystem<Real>::SubdomainSystem(MPI_Comm communicator, std::string name)
    : communicator_(communicator),
      name_(std::move(name)),
      rows_(communicator),
      matrices_(communicator),
      interface_(communicator, name_ + " interface") {}

template <class Real>
void SubdomainSystem<Real>::reinit(const std::vector<std::vector<Index>>& cells,
                                   const std::vector<unsigned int>& process, const dealii::IndexSet& owned) {
    factors_.reset();  // before anything new: they and the matrices are most of a run's memory
    own_matrices_ = assigned_matrices_ = {};
    sizes_.clear();
    std::vector<std::size_t> squares;
    for (const auto& cell : cells) {
        sizes_.push_back(cell.size());
        squares.push_back(cell.size() * cell.size());
    }
    rows_.reinit(process, sizes_);
    matrices_.reinit(process, squares);
    own_rows_.resize(rows_.own_size());
    own_matrices_.resize(matrices_.own_size());

    CellExchange counts(communicator_);
    counts.reinit(process, std::vector<std::size_t>(cells.size(), 1));
    std::vector<int> own_counts(cells.size()), assigned_counts;
    std::vector<Index> own_unknowns(rows_.own_size()), unknowns;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        own_counts[counts.begin(cell)] = static_cast<int>(sizes_[cell]);
        std::copy(cells[cell].begin(), cells[cell].end(), &own_unknowns[rows_.begin(cell)]);
    }
    counts.hand_over(own_counts, assigned_counts);
    rows_.hand_over(own_unknowns, unknowns);
    number(unknowns, owned);
    cells_.begin = {1};
    for (const int count : assigned_counts) cells_.begin.push_back(cells_.begin.back() + count);
    right_hand_side_.reinit(cells_.size);
    solution_.reinit(cells_.size);
    shared_values_.reinit(shared_);
    factors_ = mumps_factors<Real>(cells_, shared_);
    factors_valid_ = false;
}

template <class Real>
void SubdomainSystem<Real>::number(const std::vector<Index>& unknowns, const dealii::IndexSet& owned) {
    dealii::IndexSet here(owned.size());
    {
        std::vector<Index> sorted = unknowns;
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        here.add_indices(sorted.begin(), sorted.end());
    }
    Vector processes(owned, here, communicator_), numbers(owned, here, communicator_);
    for (const Index i : here) processes(i) += 1;
    processes.compress(dealii::VectorOperation::add);
    processes.update_ghost_values();
    const auto is_shared = [&processes](Index i) { return processes(i) > 1; };

    // Shared unknowns are numbered by their owners.
    std::vector<Index> own_shared;
    for (const Index i : owned)
        if (is_shared(i)) own_shared.push_back(i);
    const dealii::IndexSet own_range = dealii::Utilities::MPI::create_ascending_partitioning(
        communicator_, static_cast<Index>(own_shared.size()))[dealii::Utilities::MPI::this_mpi_process(communicator_)];
    for (Index k = 0; k < own_shared.size(); ++k)
        numbers(own_shared[k]) = static_cast<double>(own_range.nth_index_in_set(k));
    numbers.update_ghost_values();

    std::vector<int> own_number(here.n_elements());  // by the index in `here`
    std::vector<Index> shared;
    int next = 0;
    for (const Index i : here)
        if (!is_shared(i)) own_number[here.index_within_set(i)] = ++next;
    for (const Index i : here)
        if (is_shared(i)) {
            own_number[here.index_within_set(i)] = ++next;
            shared.push_back(static_cast<Index>(numbers(i)));
        }
    cells_.size = static_cast<unsigned int>(next);
    shared_ = static_cast<unsigned int>(shared.size());
    interface_.reinit(own_range, shared);
    cells_.unknowns.clear();
    for (const Index i : unknowns) cells_.unknowns.push_back(own_number[here.index_within_set(i)]);
}

template <class Real>
void SubdomainSystem<Real>::set(std::size_t cell, const dealii::Vector<double>& right_hand_side) {
    std::copy(right_hand_side.begin(), right_hand_side.end(), &own_rows_[rows_.begin(cell)]);
}

template <class Real>
bool SubdomainSystem<Real>::everywhere(bool own) const {
    return dealii::Utilities::MPI::min(own ? 1 : 0, communicator_) == 1;
}

template <class Real>
void SubdomainSystem<Real>::require_finite(const dealii::Vector<double>& vector, const char* what) const {
    if (!everywhere(vector.size() == 0 || std::isfinite(vector.l2_norm())))
        throw SolverError("not-a-number", std::string("the ") + what + " of the " + name_ + " system is not finite",
                          "use a smaller time.max_step or phase_field.cell_size");
}

template <class Real>
void SubdomainSystem<Real>::require_solved(bool own) const {
    if (!everywhere(own))
        throw SolverError("linear-solver", "MUMPS could not solve the " + name_ + " system",
                          "use a smaller time.max_step or more memory");
}

template <class Real>
void SubdomainSystem<Real>::factorise() {
    factors_valid_ = false;
    dealii::FullMatrix<double> left;
    const bool exchanged = !matrices_.all_stay();
    if (exchanged) matrices_.hand_over(own_matrices_, assigned_matrices_);
    require_solved(factors_->factorise(exchanged ? assigned_matrices_ : own_matrices_, left));
    require_solved(interface_.factorise(left));
}

template <class Real>
void SubdomainSystem<Real>::sum_right_hand_sides() {
    rows_.hand_over(own_rows_, assigned_rows_);
    right_hand_side_ = 0;
    for (std::size_t k = 0; k < assigned_rows_.size(); ++k) right_hand_side_(in_sum(k)) += assigned_rows_[k];
    require_finite(right_hand_side_, "residual");
}

template <class Real>
void SubdomainSystem<Real>::substitute() {
    const bool reduced = factors_->reduce(right_hand_side_, shared_values_);
    interface_.solve(shared_values_);
    const bool expanded = factors_->expand(shared_values_, solution_);
    require_solved(reduced && expanded);
    require_finite(solution_, "solution");
    for (std::size_t k = 0; k < cells_.unknowns.size(); ++k) assigned_rows_[k] = solution_(in_sum(k));
    rows_.give_back(assigned_rows_, own_rows_);
}

template <class Real>
void SubdomainSystem<Real>::solve() {
    sum_right_hand_sides();
    factorise();
    substitute();
    factors_valid_ = true;
}

template <class Real>
void SubdomainSystem<Real>::apply_factors() {
    sum_right_hand_sides();
    substitute();
}

template class SubdomainSystem<float>;
template class SubdomainSystem<double>;

}  // namespace endoflow::phasefield
