#include "boundary_integral/integration/lapack_solver.h"

#include <optional>

#include "boundary_integral/flow/dense_solver.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

struct Content {
    std::optional<LuFactors> factors;
    std::string& failure;
};

Content& content_of(SUNLinearSolver solver) {
    return *static_cast<Content*>(solver->content);
}

SUNLinearSolver_Type type(SUNLinearSolver) {
    return SUNLINEARSOLVER_DIRECT;
}

int set_up(SUNLinearSolver solver, SUNMatrix matrix) {
    Content& content = content_of(solver);
    try {
        content.factors.emplace(Eigen::MatrixXd(values_of(matrix)), "iteration");
        return solver_success;
    } catch (const SolverError& error) {
        content.failure = error.what();
        return SUNLS_LUFACT_FAIL;
    }
}

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector solution, N_Vector right_hand_side, sunrealtype) {
    values_of(solution) = values_of(right_hand_side);
    content_of(solver).factors->solve_in_place(values_of(solution));
    return solver_success;
}

int free_solver(SUNLinearSolver solver) {
    delete static_cast<Content*>(solver->content);  // NOLINT(cppcoreguidelines-owning-memory): SUNDIALS' ownership
    solver->content = nullptr;
    SUNLinSolFreeEmpty(solver);
    return solver_success;
}

}  // namespace

LinearSolverHandle lapack_solver(SUNContext context, std::string& failure) {
    SUNLinearSolver solver = SUNLinSolNewEmpty(context);
    solver->ops->gettype = type;
    solver->ops->setup = set_up;
    solver->ops->solve = solve;
    solver->ops->free = free_solver;
    solver->content = new Content{std::nullopt, failure};  // NOLINT(cppcoreguidelines-owning-memory): see free_solver
    return LinearSolverHandle(solver);
}

}  // namespace endoflow::boundary_integral
