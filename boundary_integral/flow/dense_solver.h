#pragma once

// Dense LU factorisation with partial pivoting, column-major: by LAPACK (dgetrf/dgetrs), or by Eigen without it.

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace endoflow::boundary_integral {

/// Our own threads share the work; those of a BLAS library would only spin beside them on matrices of this size.
void hold_blas_to_one_thread();

class LuFactors {
  public:
    /// Throws SolverError("singular-matrix") naming `what` when a pivot vanishes or an entry is not finite.
    LuFactors(Eigen::MatrixXd matrix, const char* what);

    void solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_hand_sides) const;
    [[nodiscard]] Eigen::MatrixXd solve(Eigen::MatrixXd right_hand_sides) const;
    [[nodiscard]] Eigen::MatrixXd solve_transposed(Eigen::MatrixXd right_hand_sides) const;

  private:
    Eigen::MatrixXd factors_;
    std::vector<int> pivots_;
};

/// The inverse of a matrix that is far from singular: products with it are three times as fast as solutions.
[[nodiscard]] inline Eigen::MatrixXd inverse(Eigen::MatrixXd matrix, const char* what) {
    const Eigen::Index size = matrix.rows();
    return LuFactors(std::move(matrix), what).solve(Eigen::MatrixXd::Identity(size, size));
}

}  // namespace endoflow::boundary_integral
