#include "boundary_integral/flow/dense_solver.h"

#include <string>
#include <utility>

#include <cblas.h>
#include <lapacke.h>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

void hold_blas_to_one_thread() {
    openblas_set_num_threads(1);
}

LuFactors::LuFactors(Eigen::MatrixXd matrix, const char* what) : factors_(std::move(matrix)) {
    const int n = static_cast<int>(factors_.rows());
    pivots_.resize(static_cast<std::size_t>(n));
    const int info =
        factors_.allFinite() ? LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data()) : -1;
    if (info != 0) {
        throw SolverError("singular-matrix", std::string("the ") + what + " matrix cannot be factored",
                          "use more elements or a smaller time step");
    }
}

void LuFactors::solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_hand_sides) const {
    const int n = static_cast<int>(factors_.rows());
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, static_cast<int>(right_hand_sides.cols()), factors_.data(), n,
                        pivots_.data(), right_hand_sides.data(), static_cast<int>(right_hand_sides.outerStride()));
}

Eigen::MatrixXd LuFactors::solve(Eigen::MatrixXd right_hand_sides) const {
    solve_in_place(right_hand_sides);
    return right_hand_sides;
}

Eigen::MatrixXd LuFactors::solve_transposed(Eigen::MatrixXd right_hand_sides) const {
    const int n = static_cast<int>(factors_.rows());
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', n, static_cast<int>(right_hand_sides.cols()), factors_.data(), n,
                        pivots_.data(), right_hand_sides.data(), n);
    return right_hand_sides;
}

}  // namespace endoflow::boundary_integral
