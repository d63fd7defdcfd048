#pragma once

// Linear systems dY/dt = L(t) Y with stiff matrices L, several of them side by side on common steps.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "boundary_integral/modes/step_control.h"

namespace endoflow::boundary_integral {

/// L at one time, and the norm that errors are measured in.
struct LinearRate {
    Eigen::MatrixXd matrix;  ///< square, 1/µs
    Eigen::MatrixXd root;    ///< |y| is the Euclidean norm of root y
};

/// Radau IIA collocation of order 5 (Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.8): damps
/// what decays within a step, and needs L at three times of it only. Steps follow the embedded error estimate.
class LinearPropagation {
  public:
    using Rates = std::function<std::vector<LinearRate>(double time)>;

    /// From Y_k(begin) = start[k]. The estimated error of a step, in the Frobenius norm of root Y, is held below
    /// `tolerance` times that of Y. `first_step` in µs.
    LinearPropagation(Rates rates, double begin, std::vector<Eigen::MatrixXd> start, double first_step,
                      double tolerance, int threads = 1);

    /// Steps to the time `end`, which the last one meets. Throws SolverError("modes-step-underflow").
    void advance(double end);

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const std::vector<Eigen::MatrixXd>& values() const { return values_; }
    [[nodiscard]] const std::vector<LinearRate>& rates() const { return now_; }  // at time()
    [[nodiscard]] long steps() const { return steps_; }
    [[nodiscard]] long evaluations() const { return evaluations_; }  // of L

  private:
    Rates rates_;
    double time_, tolerance_;
    StepControl control_;
    int threads_;
    std::vector<Eigen::MatrixXd> values_;
    std::vector<LinearRate> now_;
    long steps_ = 0, evaluations_ = 0;

    std::vector<LinearRate> evaluate(double time);
    void attempt(const StepControl::Step& step);
};

}  // namespace endoflow::boundary_integral
