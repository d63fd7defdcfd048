#pragma once

// Frozen-time spectra of perturbations y = (w, c'), dy/dt = L(t) y.

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace endoflow::boundary_integral {

struct Eigenmode {
    std::complex<double> rate;  // 1/us; the real part is the growth rate
    Eigen::VectorXcd shape;     // y
};

/// The `count` eigenmodes of a square matrix that grow fastest (or decay slowest), one of each conjugate pair. Throws
/// SolverError("no-spectrum") when the eigenvalues do not converge.
[[nodiscard]] std::vector<Eigenmode> fastest_modes(const Eigen::MatrixXd& matrix, std::size_t count);

}  // namespace endoflow::boundary_integral
