#pragma once

// Covariances d Sigma/dt = L Sigma + Sigma L^T + D of stiff linear systems with noise, several side by side on common
// steps.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "boundary_integral/modes/linear_propagation.h"

namespace endoflow::boundary_integral {

/// L with its norm, and D, symmetric, at one time.
struct NoisyRate {
    LinearRate linear;
    Eigen::MatrixXd noise;
};

/// Sigma = F F^T + G in two parts that do not know of each other: what the beginning has left, dF/dt = L F, and what
/// the noise has gathered since then, dG/dt = L G + G L^T + D.
struct Covariance {
    Eigen::MatrixXd inherited_root, gathered;
    [[nodiscard]] Eigen::MatrixXd total() const { return inherited_root * inherited_root.transpose() + gathered; }
};

/// The singly diagonally implicit method ARK3(2)4L[2]SA (Kennedy & Carpenter, Appl. Numer. Math. 44, 139 (2003)) of
/// order 3: damps what decays within a step, leaves what is stationary where it is, and needs L and D at three times of
/// a step. Every stage of G is a Lyapunov equation with the L of its time. Steps follow the embedded error estimates.
class CovariancePropagation {
  public:
    using Rates = std::function<std::vector<NoisyRate>(double time)>;

    /// The estimated error of a step, in the Frobenius norms of root G root^T and root F, is held below `tolerance`
    /// times that of Sigma and F. `first_step` in µs.
    CovariancePropagation(Rates rates, double begin, std::vector<Covariance> start, double first_step, double tolerance,
                          int threads = 1);

    /// Steps to the time `end`, which the last one meets; `after_step` is called after each. Throws
    /// SolverError("modes-step-underflow").
    void advance(
        double end, const std::function<void()>& after_step = [] {});

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const std::vector<Covariance>& values() const { return values_; }
    [[nodiscard]] long steps() const { return steps_; }

  private:
    Rates rates_;
    double time_, tolerance_;
    int threads_;
    StepControl control_;
    std::vector<Covariance> values_, slopes_;  // d values/dt at time()
    long steps_ = 0;

    [[nodiscard]] bool attempt(const StepControl::Step& step);
};

}  // namespace endoflow::boundary_integral
