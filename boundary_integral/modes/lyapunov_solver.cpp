#include "boundary_integral/modes/lyapunov_solver.h"

#include <lapacke.h>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

LyapunovSolver::LyapunovSolver(const Eigen::MatrixXd& matrix)
    : triangular_(matrix), vectors_(matrix.rows(), matrix.cols()) {
    const int n = static_cast<int>(matrix.rows());
    int sorted = 0;
    Eigen::VectorXd real(n), imaginary(n);
    const int info = matrix.allFinite() ? LAPACKE_dgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, triangular_.data(), n,
                                                        &sorted, real.data(), imaginary.data(), vectors_.data(), n)
                                        : -1;
    if (info != 0) {
        throw SolverError("no-schur-form", "the rates of a mode have no Schur form", "use more elements in the run");
    }
}

// (1/2 - step T) Y + Y (1/2 - step T)^T = Q^T right Q.
Eigen::MatrixXd LyapunovSolver::solve(double step, const Eigen::MatrixXd& right) const {
    const int n = static_cast<int>(triangular_.rows());
    const Eigen::MatrixXd half =
        0.5 * Eigen::MatrixXd::Identity(triangular_.rows(), triangular_.cols()) - step * triangular_;
    Eigen::MatrixXd y = vectors_.transpose() * right * vectors_;
    double scale = 1.0;  // below 1 where the solution overflows
    LAPACKE_dtrsyl(LAPACK_COL_MAJOR, 'N', 'T', 1, n, n, half.data(), n, half.data(), n, y.data(), n, &scale);
    const Eigen::MatrixXd x = vectors_ * (y / scale) * vectors_.transpose();
    return 0.5 * (x + x.transpose());
}

}  // namespace endoflow::boundary_integral
