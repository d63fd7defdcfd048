#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <deque>
#include <string>
#include <vector>

#include "phasefield/solver/condensed_system.h"

namespace endoflow::phasefield {

/// A linear system on a space, solved approximately by a sweep of the block Gauss–Seidel method: one block of
/// components after the other as if those to come were zero,
///     x_k = A_kk⁻¹ (r_k − Σ_{l<k} A_kl x_l).
/// The factors of the blocks are smaller than those of the whole; iterations that find the residual of the whole make
/// up for the rest. With one block the solution is exact.
class BlockGaussSeidel {
  public:
    using Cell = CondensedSystem::Cell;

    /// `blocks`: the space's components, each in one block, ascending there. No block is empty.
    BlockGaussSeidel(MPI_Comm communicator, const std::string& name,
                     const std::vector<std::vector<unsigned int>>& blocks);

    /// As of CondensedSystem.
    void reinit(const Space& space, const std::vector<unsigned int>& process);
    /// A cell's n × n matrix and n right-hand sides, in its own numbering. Set those of all own cells, then solve().
    void set(const Cell& cell, const dealii::FullMatrix<double>& matrix, const dealii::Vector<double>& right_hand_side);
    /// The right-hand sides alone. Set those of all own cells, then apply_factors().
    void set(const Cell& cell, const dealii::Vector<double>& right_hand_side);

    /// As of CondensedSystem.
    void use(Precision precision);
    [[nodiscard]] Precision precision() const { return blocks_.front().system.precision(); }
    void forget_factors();
    [[nodiscard]] bool has_factors() const;
    void solve(const Space& space, Vector& solution);
    void apply_factors(const Space& space, Vector& solution);
    /// Of all blocks.
    [[nodiscard]] CondensedSystem::Index shared_unknowns() const;
    [[nodiscard]] double operations() const;

  private:
    struct Block {
        Block(MPI_Comm communicator, const std::string& name, const std::vector<unsigned int>& components)
            : system(communicator, name, components) {}

        CondensedSystem system;
        std::vector<unsigned int> earlier;                      // unknowns of earlier blocks in a cell's numbering
        std::vector<dealii::LAPACKFullMatrix<float>> coupling;  // A_kl of own cells, l = 0 … k − 1 side by side
    };

    /// Which one of the own cells this is.
    [[nodiscard]] std::size_t position(const Cell& cell) const { return blocks_.front().system.position(cell); }
    /// The right-hand side of a block's system, from the solutions of the earlier ones.
    void hand_over(const Space& space, const Vector& solution, Block& block);

    std::deque<Block> blocks_;                       // systems cannot be moved
    std::vector<dealii::Vector<double>> residuals_;  // r of own cells, less the parts of earlier blocks
};

}  // namespace endoflow::phasefield
