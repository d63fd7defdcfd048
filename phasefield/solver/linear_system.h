#pragma once

#include <deal.II/base/table.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <string>

#include "phasefield/fem/space.h"

typedef struct _p_KSP* KSP;

namespace endoflow::phasefield {

using Couplings = dealii::Table<2, dealii::DoFTools::Coupling>;

/// A sparse linear system on a space, solved by MUMPS through PETSc. The symbolic analysis is done once per mesh, and
/// the last factors serve as the preconditioner of GMRES for as long as they serve well.
class LinearSystem {
  public:
    LinearSystem(MPI_Comm communicator, std::string name);
    ~LinearSystem();
    LinearSystem(const LinearSystem&) = delete;
    LinearSystem& operator=(const LinearSystem&) = delete;

    /// Allocates for the present mesh. `couplings(i, k)` says whether component i's rows contain component k.
    void reinit(const Space& space, const Couplings& couplings);
    /// Allocates for unknowns of which this process owns `owned`, with the rows of `pattern`.
    void reinit(const dealii::IndexSet& owned, const dealii::DynamicSparsityPattern& pattern);
    /// Zero matrix and right-hand side; then assemble into `matrix` and `right_hand_side`, then solve().
    void start();
    /// The next solve factorises anew (call it when the matrix has changed much, e.g. with the time step).
    void forget_factors() { factors_valid_ = false; }
    [[nodiscard]] bool has_factors() const { return factors_valid_; }
    /// Solves and satisfies the constraints; ghost values of `solution` are updated.
    /// Throws SolverError("linear-solver", …) when the factorisation fails or the result is not finite.
    void solve(const dealii::AffineConstraints<double>& constraints, Vector& solution);

    /// The last factors applied to right_hand_side: a step of the chord method.
    void apply_factors(const dealii::AffineConstraints<double>& constraints, Vector& solution);

    dealii::PETScWrappers::MPI::SparseMatrix matrix;
    dealii::PETScWrappers::MPI::Vector right_hand_side;

  private:
    void destroy();
    void renew_solver();
    bool attempt();
    void require_finite_residual() const;
    void hand_out(const dealii::AffineConstraints<double>& constraints, Vector& solution) const;

    MPI_Comm communicator_;
    std::string name_;
    dealii::PETScWrappers::MPI::Vector solution_;
    KSP solver_ = nullptr;
    bool factors_valid_ = false;
};

}  // namespace endoflow::phasefield
