#pragma once

#include <string>

#include "boundary_integral/integration/sundials_handles.h"

namespace endoflow::boundary_integral {

/// A SUNLinearSolver that factors a dense SUNMatrix by LAPACK. SUNDIALS' own dense LU is plain C without blocking, and
/// Debian's SUNDIALS has no LAPACK interface. A matrix that cannot be factored is a recoverable failure; what was
/// wrong with it is written to `failure`, which must outlive the solver.
[[nodiscard]] LinearSolverHandle lapack_solver(SUNContext context, std::string& failure);

}  // namespace endoflow::boundary_integral
