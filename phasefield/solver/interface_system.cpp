#include "phasefield/solver/interface_system.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/sparsity_tools.h>

namespace endoflow::phasefield {

InterfaceSystem::InterfaceSystem(MPI_Comm communicator, std::string name, Index most_dense)
    : communicator_(communicator), most_dense_(most_dense), sparse_(communicator, std::move(name)) {
    no_constraints_.close();
}

void InterfaceSystem::reinit(const dealii::IndexSet& owned, const std::vector<Index>& numbers) {
    numbers_ = numbers;
    size_ = owned.size();
    few_ = size_ <= most_dense_;
    if (few_) {
        dense_values_.reinit(size_);
        return;
    }
    dealii::IndexSet known = owned;
    known.add_indices(numbers.begin(), numbers.end());
    dealii::DynamicSparsityPattern pattern(known);
    for (const Index row : numbers) pattern.add_entries(row, numbers.begin(), numbers.end());
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, communicator_, known);
    sparse_.reinit(owned, pattern);
    sparse_solution_.reinit(owned, known, communicator_);
}

bool InterfaceSystem::factorise(const dealii::FullMatrix<double>& own) {
    if (size_ == 0) return true;
    if (!few_) {
        sparse_.start();
        sparse_.forget_factors();
        if (!numbers_.empty()) sparse_.matrix.add(numbers_, own);
        return true;
    }
    dense_.reinit(size_);
    for (unsigned int i = 0; i < numbers_.size(); ++i)
        for (unsigned int k = 0; k < numbers_.size(); ++k) dense_(numbers_[i], numbers_[k]) = own(i, k);
    dealii::Utilities::MPI::sum(dense_, communicator_, dense_);
    try {
        dense_.compute_lu_factorization();
    } catch (const dealii::LACExceptions::ExcSingular&) {
        return false;
    }
    return true;
}

void InterfaceSystem::solve(dealii::Vector<double>& own) {
    if (size_ == 0) return;
    if (few_) {
        dense_values_ = 0;
        for (unsigned int i = 0; i < numbers_.size(); ++i) dense_values_(numbers_[i]) = own(i);
        dealii::Utilities::MPI::sum(dense_values_, communicator_, dense_values_);
        dense_.solve(dense_values_);
        for (unsigned int i = 0; i < numbers_.size(); ++i) own(i) = dense_values_(numbers_[i]);
        return;
    }
    sparse_.right_hand_side = 0;
    if (!numbers_.empty()) sparse_.right_hand_side.add(numbers_, own);
    if (sparse_.has_factors())
        sparse_.apply_factors(no_constraints_, sparse_solution_);
    else
        sparse_.solve(no_constraints_, sparse_solution_);
    for (unsigned int i = 0; i < numbers_.size(); ++i) own(i) = sparse_solution_(numbers_[i]);
}

}  // namespace endoflow::phasefield
