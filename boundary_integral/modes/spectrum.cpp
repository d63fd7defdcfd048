#include "boundary_integral/modes/spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

std::vector<Eigenmode> fastest_modes(const Eigen::MatrixXd& matrix, std::size_t count) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
    if (solver.info() != Eigen::Success) {
        throw SolverError("no-spectrum", "the eigenvalues of a mode do not converge", "use more elements in the run");
    }
    const Eigen::VectorXcd& values = solver.eigenvalues();
    std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](Eigen::Index i) { return values[i].imag() < 0.0; });
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return values[i].real() > values[j].real(); });
    order.resize(std::min(count, order.size()));
    const Eigen::MatrixXcd vectors = solver.eigenvectors();
    std::vector<Eigenmode> modes;
    for (const Eigen::Index i : order) modes.push_back({values[i], vectors.col(i)});
    return modes;
}

}  // namespace endoflow::boundary_integral
