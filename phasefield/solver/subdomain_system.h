#pragma once

#include <deal.II/base/index_set.h>

#include <memory>
#include <string>
#include <vector>

#include "phasefield/solver/cell_exchange.h"
#include "phasefield/solver/interface_system.h"
#include "phasefield/solver/mumps_factors.h"

namespace endoflow::phasefield {

/// A linear system whose matrix is the sum of dense ones of cells. Each cell is assigned to a process, which need not
/// be the one that computes it. Unknowns of the cells of one process alone are eliminated there, by a factorisation
/// that takes no communication. What is left, the unknowns that processes share, is a system of its own for all of
/// them. The factors are used until they are made anew. Matrices and factors are of Real, float or double, the rest
/// of double precision.
template <class Real>
class SubdomainSystem {
  public:
    using Index = dealii::types::global_dof_index;

    SubdomainSystem(MPI_Comm communicator, std::string name);

    /// Allocates. `cells`: the unknowns of each own cell, `process`: the one that it is assigned to, `owned`: unknowns
    /// that this process owns.
    void reinit(const std::vector<std::vector<Index>>& cells, const std::vector<unsigned int>& process,
                const dealii::IndexSet& owned);
    /// A cell's n × n matrix, column by column. Set those of all own cells, then solve().
    [[nodiscard]] Real* matrix(std::size_t cell) { return &own_matrices_[matrices_.begin(cell)]; }
    /// Set those of all own cells, then solve() or apply_factors().
    void set(std::size_t cell, const dealii::Vector<double>& right_hand_side);

    void forget_factors() { factors_valid_ = false; }
    [[nodiscard]] bool has_factors() const { return factors_valid_; }
    /// New factors, and the solution of all own cells. Collective, with the same errors on all processes.
    /// Throws SolverError("linear-solver", …) when the factorisation fails, ("not-a-number", …) when the right-hand
    /// side or the result is not finite.
    void solve();
    /// The last factors applied to the right-hand side.
    void apply_factors();
    /// How many an own cell has.
    [[nodiscard]] unsigned int unknowns(std::size_t cell) const { return static_cast<unsigned int>(sizes_[cell]); }
    /// The solution at an own cell's unknowns.
    [[nodiscard]] const double* values(std::size_t cell) const { return &own_rows_[rows_.begin(cell)]; }
    /// Of this process in a factorisation.
    [[nodiscard]] double operations() const { return factors_->operations(); }
    /// Of all processes together.
    [[nodiscard]] Index shared_unknowns() const { return interface_.size(); }

  private:
    /// Own numbers of the unknowns of the cells that this process is assigned, where shared ones come last.
    void number(const std::vector<Index>& unknowns, const dealii::IndexSet& owned);
    /// Of the unknown of a cell's row, by its place in all assigned rows.
    [[nodiscard]] unsigned int in_sum(std::size_t place) const {
        return static_cast<unsigned int>(cells_.unknowns[place] - 1);
    }
    void sum_right_hand_sides();
    void factorise();
    void substitute();
    /// Whether it is true on all processes. Collective.
    [[nodiscard]] bool everywhere(bool own) const;
    void require_solved(bool own) const;
    void require_finite(const dealii::Vector<double>& vector, const char* what) const;

    MPI_Comm communicator_;
    std::string name_;
    std::vector<std::size_t> sizes_;  // unknowns of own cells
    CellExchange rows_, matrices_;
    std::vector<double> own_rows_, assigned_rows_;        // right-hand sides, then solutions
    std::vector<Real> own_matrices_, assigned_matrices_;  // of own cells, and of those that this process eliminates
    CellMatrices cells_;
    unsigned int shared_ = 0;  // the last of cells_.size unknowns are other processes', too
    dealii::Vector<double> right_hand_side_, solution_, shared_values_;
    std::unique_ptr<MumpsFactors<Real>> factors_;
    InterfaceSystem interface_;
    bool factors_valid_ = false;
};

}  // namespace endoflow::phasefield
