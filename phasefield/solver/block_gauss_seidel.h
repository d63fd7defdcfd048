#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <string>
#include <vector>

#include "phasefield/solver/condensed_system.h"

namespace endoflow::phasefield {

/// A linear system on a space, solved approximately by a sweep of the block Gauss–Seidel method: the components of one
/// block as if those of the other were zero, then the others,
///     x₁ = A₁₁⁻¹ r₁,   x₂ = A₂₂⁻¹ (r₂ − A₂₁ x₁).
/// The factors of two blocks are smaller than those of the whole; iterations that find the residual of the whole make
/// up for the rest.
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
    /// A cell's n × n matrix and n right-hand sides, in its own numbering.
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
    /// A block's unknowns in a cell's numbering, with room for their values.
    struct Block {
        std::vector<unsigned int> components, in_cell;
        dealii::Vector<float> values;
    };
    /// What is kept of a cell.
    struct Coupling {
        dealii::LAPACKFullMatrix<float> A_21;
        dealii::Vector<double> residual;  // r
    };

    /// The right-hand side of the second system, from the solution of the first.
    void hand_over(const Space& space, const Vector& solution);

    Block one_, two_;
    CondensedSystem first_, second_;
    std::vector<Coupling> cells_;         // own ones
    std::vector<std::size_t> positions_;  // in cells_, by the active cell's index
    dealii::Vector<double> cell_values_;
};

}  // namespace endoflow::phasefield
