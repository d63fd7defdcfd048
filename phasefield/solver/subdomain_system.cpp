#include "phasefield/solver/subdomain_system.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "shared/support/error.h"

namespace endoflow::phasefield {

SubdomainSystem::SubdomainSystem(MPI_Comm communicator, std::string name)
    : communicator_(communicator), name_(std::move(name)), interface_(communicator, name_ + " interface") {}

void SubdomainSystem::reinit(const std::vector<std::vector<Index>>& cells, const dealii::IndexSet& owned,
                             const dealii::IndexSet& relevant, const dealii::AffineConstraints<double>& constraints) {
    factors_.reset();  // before anything new: they and the matrix are most of a run's memory
    matrix_.clear();
    number(cells, owned, relevant, constraints);
    dealii::DynamicSparsityPattern pattern(size_, size_);
    for (const auto& cell : cells_) constraints_.add_entries_local_to_global(cell, pattern, false);
    pattern_.copy_from(pattern);
    matrix_.reinit(pattern_);
    right_hand_side_.reinit(size_);
    solution_.reinit(size_);
    shared_values_.reinit(shared_);
    precision_ = Precision::single;
    factors_ = mumps_factors(pattern_, shared_, precision_);
    factors_valid_ = false;
}

void SubdomainSystem::use(Precision precision) {
    if (precision == precision_) return;
    precision_ = precision;
    factors_valid_ = false;
    if (!factors_) return;
    factors_.reset();
    factors_ = mumps_factors(pattern_, shared_, precision_);
}

void SubdomainSystem::number(const std::vector<std::vector<Index>>& cells, const dealii::IndexSet& owned,
                             const dealii::IndexSet& relevant, const dealii::AffineConstraints<double>& constraints) {
    std::set<Index> free, constrained;
    for (const auto& cell : cells)
        for (const Index i : cell) {
            if (!constraints.is_constrained(i)) {
                free.insert(i);
                continue;
            }
            constrained.insert(i);
            for (const auto& [master, weight] : *constraints.get_constraint_entries(i)) free.insert(master);
        }
    Vector processes(owned, relevant, communicator_), numbers(owned, relevant, communicator_);
    for (const Index i : free) processes(i) += 1;
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

    std::map<Index, Index> own_number;
    std::vector<Index> shared;
    Index next = 0;
    for (const Index i : constrained) own_number[i] = next++;
    for (const Index i : free)
        if (!is_shared(i)) own_number[i] = next++;
    for (const Index i : free)
        if (is_shared(i)) {
            own_number[i] = next++;
            shared.push_back(static_cast<Index>(numbers(i)));
        }
    size_ = static_cast<unsigned int>(next);
    shared_ = static_cast<unsigned int>(shared.size());
    interface_.reinit(own_range, shared);
    cells_.assign(cells.size(), {});
    for (std::size_t k = 0; k < cells.size(); ++k)
        for (const Index i : cells[k]) cells_[k].push_back(own_number.at(i));
    constraints_.clear();
    constraints_.reinit(dealii::complete_index_set(size_));
    for (const Index i : constrained) {
        constraints_.add_line(own_number.at(i));
        for (const auto& [master, weight] : *constraints.get_constraint_entries(i))
            constraints_.add_entry(own_number.at(i), own_number.at(master), weight);
    }
    constraints_.close();
}

void SubdomainSystem::start() {
    matrix_ = 0;
    right_hand_side_ = 0;
}

void SubdomainSystem::add(std::size_t cell, const dealii::FullMatrix<double>& matrix) {
    constraints_.distribute_local_to_global(matrix, cells_[cell], matrix_);
}

void SubdomainSystem::add(std::size_t cell, const dealii::Vector<double>& right_hand_side) {
    constraints_.distribute_local_to_global(right_hand_side, cells_[cell], right_hand_side_);
}

bool SubdomainSystem::everywhere(bool own) const {
    return dealii::Utilities::MPI::min(own ? 1 : 0, communicator_) == 1;
}

void SubdomainSystem::require_finite(const dealii::Vector<double>& vector, const char* what) const {
    if (!everywhere(vector.size() == 0 || std::isfinite(vector.l2_norm())))
        throw SolverError("not-a-number", std::string("the ") + what + " of the " + name_ + " system is not finite",
                          "use a smaller time.max_step or phase_field.cell_size");
}

void SubdomainSystem::require_solved(bool own) const {
    if (!everywhere(own))
        throw SolverError("linear-solver", "MUMPS could not solve the " + name_ + " system",
                          "use a smaller time.max_step or more memory");
}

void SubdomainSystem::factorise() {
    factors_valid_ = false;
    dealii::FullMatrix<double> left;
    require_solved(factors_->factorise(matrix_, left));
    require_solved(interface_.factorise(left));
}

void SubdomainSystem::substitute() {
    const bool reduced = factors_->reduce(right_hand_side_, shared_values_);
    interface_.solve(shared_values_);
    const bool expanded = factors_->expand(shared_values_, solution_);
    constraints_.distribute(solution_);
    require_solved(reduced && expanded);
    require_finite(solution_, "solution");
}

void SubdomainSystem::solve() {
    require_finite(right_hand_side_, "residual");
    factorise();
    substitute();
    factors_valid_ = true;
}

void SubdomainSystem::apply_factors() {
    require_finite(right_hand_side_, "residual");
    substitute();
}

void SubdomainSystem::values(std::size_t cell, dealii::Vector<double>& out) const {
    const auto& indices = cells_[cell];
    for (unsigned int i = 0; i < indices.size(); ++i) out(i) = solution_(indices[i]);
}

}  // namespace endoflow::phasefield
