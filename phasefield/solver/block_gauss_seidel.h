#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <string>
#include <vector>

#include "phasefield/solver/condensed_system.h"

namespace endoflow::phasefield {

/// A linear system on a space, solved approximately by one sweep of the block Gauss–Seidel method: first the components
/// of one block, as if those of the other were zero, then the others with what they hold of the first,
///     x₁ = A₁₁⁻¹ r₁,   x₂ = A₂₂⁻¹ (r₂ − A₂₁ x₁).
/// The factors of two blocks are smaller than those of the whole; iterations that find the residual of the whole make
/// up for A₁₂.
class BlockGaussSeidel {
  public:
    using Cell = CondensedSystem::Cell;

    /// `first` and `second` are the space's components, each ascending.
    BlockGaussSeidel(MPI_Comm communicator, const std::string& name, std::vector<unsigned int> first,
                     std::vector<unsigned int> second);

    /// Allocates for the present mesh.
    void reinit(const Space& space);
    /// Zero matrix and right-hand side: add() all own cells, then solve().
    void start();
    /// Zero right-hand side alone: add() all own cells, then apply_factors().
    void start_right_hand_side();
    /// A cell's n × n matrix and n right-hand sides, in its own numbering. Rows of the first block are not read in
    /// columns of the second.
    void add(const Cell& cell, const dealii::FullMatrix<double>& matrix, const dealii::Vector<double>& right_hand_side);
    /// The right-hand side alone.
    void add(const Cell& cell, const dealii::Vector<double>& right_hand_side);

    /// As of CondensedSystem.
    void use(Precision precision);
    [[nodiscard]] Precision precision() const { return first_.precision(); }
    void forget_factors();
    [[nodiscard]] bool has_factors() const { return first_.has_factors() && second_.has_factors(); }
    void solve(const Space& space, Vector& solution);
    void apply_factors(const Space& space, Vector& solution);
    /// Of both blocks.
    [[nodiscard]] SubdomainSystem::Index shared_unknowns() const {
        return first_.shared_unknowns() + second_.shared_unknowns();
    }

  private:
    /// What is kept of a cell.
    struct Coupling {
        dealii::LAPACKFullMatrix<float> A_21;
        dealii::Vector<double> residual;  // r, of which the second block's rows are read
    };

    /// The second block's right-hand side, from the first one's solution.
    void hand_over(const Space& space, const Vector& solution);

    std::vector<unsigned int> components_[2];
    CondensedSystem first_, second_;
    std::vector<unsigned int> in_cell_[2];  // the blocks' unknowns in a cell's numbering
    std::vector<Coupling> cells_;           // own ones
    std::vector<std::size_t> positions_;    // in cells_, by the active cell's index
    dealii::Vector<float> x_1_, change_;    // of a cell
};

}  // namespace endoflow::phasefield
