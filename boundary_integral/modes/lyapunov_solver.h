#pragma once

// Implicit steps of d Sigma/dt = L Sigma + Sigma L^T.

#include <Eigen/Core>

namespace endoflow::boundary_integral {

/// By the real Schur form of L, L = Q T Q^T (Bartels & Stewart 1972): LAPACK's dgees and dtrsyl.
class LyapunovSolver {
  public:
    /// L, square, 1/µs. Throws SolverError("no-schur-form").
    explicit LyapunovSolver(const Eigen::MatrixXd& matrix);

    /// X with X - step (L X + X L^T) = right, symmetric as `right` is; step in µs.
    [[nodiscard]] Eigen::MatrixXd solve(double step, const Eigen::MatrixXd& right) const;

  private:
    Eigen::MatrixXd triangular_, vectors_;  // T, Q
};

}  // namespace endoflow::boundary_integral
