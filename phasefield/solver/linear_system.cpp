#include "phasefield/solver/linear_system.h"

#include <deal.II/lac/sparsity_tools.h>
#include <petscksp.h>

#include <cmath>

#include "phasefield/solver/mumps_ordering.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

constexpr double relative_tolerance = 1e-11;
constexpr int worthwhile_iterations = 10;  // beyond this a new factorisation is cheaper than the old factors
constexpr int most_iterations = 30;

void check(PetscErrorCode code, const std::string& name) {
    if (code != 0)
        throw SolverError("linear-solver",
                          "PETSc returned error " + std::to_string(code) + " in the " + name + " system",
                          "use a smaller time.max_step or more memory");
}

}  // namespace

LinearSystem::LinearSystem(MPI_Comm communicator, std::string name)
    : communicator_(communicator), name_(std::move(name)) {}

LinearSystem::~LinearSystem() {
    destroy();
}

void LinearSystem::destroy() {
    if (solver_ != nullptr) KSPDestroy(&solver_);
    solver_ = nullptr;
    factors_valid_ = false;
}

void LinearSystem::reinit(const Space& space, const Couplings& couplings) {
    dealii::DynamicSparsityPattern pattern(space.relevant);
    dealii::DoFTools::make_sparsity_pattern(space.dofs, couplings, pattern, space.constraints, false,
                                            dealii::Utilities::MPI::this_mpi_process(communicator_));
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, space.owned, communicator_, space.relevant);
    reinit(space.owned, pattern);
}

void LinearSystem::reinit(const dealii::IndexSet& owned, const dealii::DynamicSparsityPattern& pattern) {
    destroy();
    matrix.reinit(owned, owned, pattern, communicator_);
    right_hand_side.reinit(owned, communicator_);
    solution_.reinit(owned, communicator_);
    renew_solver();
}

void LinearSystem::renew_solver() {
    destroy();
    check(KSPCreate(communicator_, &solver_), name_);
    check(KSPSetType(solver_, KSPGMRES), name_);
    check(KSPGMRESSetRestart(solver_, most_iterations), name_);
    check(KSPSetPCSide(solver_, PC_RIGHT), name_);
    check(KSPSetTolerances(solver_, relative_tolerance, 1e-300, PETSC_DEFAULT, most_iterations), name_);
    check(KSPSetOperators(solver_, matrix, matrix), name_);
    PC preconditioner;
    check(KSPGetPC(solver_, &preconditioner), name_);
    check(PCSetType(preconditioner, PCLU), name_);
    check(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS), name_);
    check(PCFactorSetUpMatSolverType(preconditioner), name_);
    Mat factors;
    check(PCFactorGetMatrix(preconditioner, &factors), name_);
    check(MatMumpsSetIcntl(factors, 7, static_cast<int>(MumpsOrdering::minimum_degree_of_quasi_dense)), name_);
    check(MatMumpsSetIcntl(factors, 28, 1), name_);   // sequential analysis
    check(MatMumpsSetIcntl(factors, 14, 60), name_);  // 60 % more workspace than estimated
}

void LinearSystem::start() {
    matrix = 0;
    right_hand_side = 0;
}

bool LinearSystem::attempt() {
    check(KSPSetReusePreconditioner(solver_, factors_valid_ ? PETSC_TRUE : PETSC_FALSE), name_);
    const PetscErrorCode code = KSPSolve(solver_, right_hand_side, solution_);
    if (code != 0) return false;
    KSPConvergedReason reason;
    PetscInt iterations = 0;
    check(KSPGetConvergedReason(solver_, &reason), name_);
    check(KSPGetIterationNumber(solver_, &iterations), name_);
    if (reason < 0 || !std::isfinite(solution_.l2_norm())) return false;
    factors_valid_ = iterations <= worthwhile_iterations;
    return true;
}

void LinearSystem::require_finite_residual() const {
    if (!std::isfinite(right_hand_side.l2_norm()))
        throw SolverError("not-a-number", "the residual of the " + name_ + " system is not finite",
                          "use a smaller time.max_step");
}

void LinearSystem::solve(const dealii::AffineConstraints<double>& constraints, Vector& solution) {
    matrix.compress(dealii::VectorOperation::add);
    right_hand_side.compress(dealii::VectorOperation::add);
    require_finite_residual();
    solution_ = 0;
    const bool had_factors = factors_valid_;
    bool solved = attempt();
    if (!solved) renew_solver();  // PETSc would go on reporting the failure
    if (!solved && had_factors) {
        solution_ = 0;
        solved = attempt();
        if (!solved) renew_solver();
    }
    if (!solved)
        throw SolverError("linear-solver", "MUMPS could not solve the " + name_ + " system",
                          "use a smaller time.max_step or more memory");
    hand_out(constraints, solution);
}

void LinearSystem::apply_factors(const dealii::AffineConstraints<double>& constraints, Vector& solution) {
    right_hand_side.compress(dealii::VectorOperation::add);
    require_finite_residual();
    PC preconditioner;
    check(KSPGetPC(solver_, &preconditioner), name_);
    check(PCApply(preconditioner, right_hand_side, solution_), name_);
    if (!std::isfinite(solution_.l2_norm()))
        throw SolverError("not-a-number", "the solution of the " + name_ + " system is not finite",
                          "use a smaller time.max_step or phase_field.cell_size");
    hand_out(constraints, solution);
}

void LinearSystem::hand_out(const dealii::AffineConstraints<double>& constraints, Vector& solution) const {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(solution_, &values), name_);
    solution.zero_out_ghost_values();
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i) solution.local_element(i) = values[i];
    check(VecRestoreArrayRead(solution_, &values), name_);
    constraints.distribute(solution);
    solution.update_ghost_values();
}

}  // namespace endoflow::phasefield
