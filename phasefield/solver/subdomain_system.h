#pragma once

#include <memory>
#include <string>
#include <vector>

#include "phasefield/solver/interface_system.h"
#include "phasefield/solver/mumps_factors.h"

namespace endoflow::phasefield {

/// A linear system whose unknowns on one process alone are eliminated there, by a factorisation that takes no
/// communication. What is left, the unknowns that processes share, is a system of its own for all of them. The factors
/// are used until they are made anew.
class SubdomainSystem {
  public:
    using Index = dealii::types::global_dof_index;

    SubdomainSystem(MPI_Comm communicator, std::string name);

    /// Allocates. Each process gives the unknowns of its own cells, cell by cell; `owned`, `relevant` and `constraints`
    /// as of a space.
    void reinit(const std::vector<std::vector<Index>>& cells, const dealii::IndexSet& owned,
                const dealii::IndexSet& relevant, const dealii::AffineConstraints<double>& constraints);
    /// Zero matrix and right-hand side: add() all own cells, then solve().
    void start();
    /// Zero right-hand side alone: add() all own cells, then apply_factors().
    void start_right_hand_side() { right_hand_side_ = 0; }
    void add(std::size_t cell, const dealii::FullMatrix<double>& matrix);
    void add(std::size_t cell, const dealii::Vector<double>& right_hand_side);

    /// Of the next factors; single at first.
    void use(Precision precision);
    [[nodiscard]] Precision precision() const { return precision_; }
    void forget_factors() { factors_valid_ = false; }
    [[nodiscard]] bool has_factors() const { return factors_valid_; }
    /// New factors, and the solution of all own cells. Collective, with the same errors on all processes.
    /// Throws SolverError("linear-solver", …) when the factorisation fails, ("not-a-number", …) when the right-hand
    /// side or the result is not finite.
    void solve();
    /// The last factors applied to the right-hand side.
    void apply_factors();
    /// The solution on an own cell, constraints satisfied.
    void values(std::size_t cell, dealii::Vector<double>& out) const;
    /// Of all processes together.
    [[nodiscard]] Index shared_unknowns() const { return interface_.size(); }

  private:
    void number(const std::vector<std::vector<Index>>& cells, const dealii::IndexSet& owned,
                const dealii::IndexSet& relevant, const dealii::AffineConstraints<double>& constraints);
    void factorise();
    void substitute();
    /// Whether it is true on all processes. Collective.
    [[nodiscard]] bool everywhere(bool own) const;
    void require_solved(bool own) const;
    void require_finite(const dealii::Vector<double>& vector, const char* what) const;

    MPI_Comm communicator_;
    std::string name_;
    std::vector<std::vector<Index>> cells_;  // own numbering: shared unknowns come last
    unsigned int size_ = 0;                  // own unknowns, of which
    unsigned int shared_ = 0;                // the last ones are other processes', too
    dealii::AffineConstraints<double> constraints_;
    dealii::SparsityPattern pattern_;
    dealii::SparseMatrix<double> matrix_;
    dealii::Vector<double> right_hand_side_, solution_, shared_values_;
    Precision precision_ = Precision::single;
    std::unique_ptr<MumpsFactors> factors_;
    InterfaceSystem interface_;
    bool factors_valid_ = false;
};

}  // namespace endoflow::phasefield
