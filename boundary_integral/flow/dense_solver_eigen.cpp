// What dense_solver.cpp does with LAPACK, for machines that have none.

#include <string>
#include <utility>

#include <Eigen/LU>

#include "boundary_integral/flow/dense_solver.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

Permutation permutation(const std::vector<int>& places) {
    return Permutation(Eigen::Map<const Eigen::VectorXi>(places.data(), static_cast<Eigen::Index>(places.size())));
}

}  // namespace

void hold_blas_to_one_thread() {}

LuFactors::LuFactors(Eigen::MatrixXd matrix, const char* what) : factors_(std::move(matrix)) {
    bool regular = factors_.allFinite();
    if (regular) {
        const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> in_place(factors_);
        const auto& places = in_place.permutationP().indices();
        pivots_.assign(places.data(), places.data() + places.size());
        regular = (factors_.diagonal().array() != 0.0).all();
    }
    if (!regular)
        throw SolverError("singular-matrix", std::string("the ") + what + " matrix cannot be factored",
                          "use more elements or a smaller time step");
}

void LuFactors::solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_hand_sides) const {
    right_hand_sides = permutation(pivots_) * right_hand_sides;
    factors_.triangularView<Eigen::UnitLower>().solveInPlace(right_hand_sides);
    factors_.triangularView<Eigen::Upper>().solveInPlace(right_hand_sides);
}

Eigen::MatrixXd LuFactors::solve(Eigen::MatrixXd right_hand_sides) const {
    solve_in_place(right_hand_sides);
    return right_hand_sides;
}

Eigen::MatrixXd LuFactors::solve_transposed(Eigen::MatrixXd right_hand_sides) const {
    factors_.transpose().triangularView<Eigen::Lower>().solveInPlace(right_hand_sides);
    factors_.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(right_hand_sides);
    return permutation(pivots_).transpose() * right_hand_sides;
}

}  // namespace endoflow::boundary_integral
