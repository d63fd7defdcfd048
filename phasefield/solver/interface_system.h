#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <string>
#include <vector>

#include "phasefield/solver/linear_system.h"

namespace endoflow::phasefield {

/// The dense system of the unknowns that processes share. Few of them, as between two processes, are solved for by all
/// processes alike; many by the sparse solver of all together.
class InterfaceSystem {
  public:
    using Index = dealii::types::global_dof_index;

    /// Up to `most_dense` unknowns are few; the factors of 5000 take 8·10¹⁰ operations.
    InterfaceSystem(MPI_Comm communicator, std::string name, Index most_dense = 5000);

    /// `numbers`: which of all shared unknowns this process has. It numbers those in `owned`, a range.
    void reinit(const dealii::IndexSet& owned, const std::vector<Index>& numbers);
    /// New factors of the sum of all processes' matrices. False when the sum is singular.
    [[nodiscard]] bool factorise(const dealii::FullMatrix<double>& own);
    /// From the own part of the right-hand side to the own part of the solution.
    void solve(dealii::Vector<double>& own);
    /// Of all processes' unknowns together.
    [[nodiscard]] Index size() const { return size_; }

  private:
    using Dense = dealii::LAPACKFullMatrix<double>;

    MPI_Comm communicator_;
    Index most_dense_;
    std::vector<Index> numbers_;
    Index size_ = 0;
    bool few_ = true;
    Dense dense_;
    dealii::Vector<double> dense_values_;
    LinearSystem sparse_;
    dealii::AffineConstraints<double> no_constraints_;
    Vector sparse_solution_;
};

}  // namespace endoflow::phasefield
