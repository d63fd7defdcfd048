#pragma once

// Variable-order, variable-step integration of stiff y' = F(y): numerical differentiation formulas of order 1 to 5
// on backward differences (Shampine & Reichelt, SIAM J. Sci. Comput. 18, 1997). Everything that the next step depends
// on is in StepHistory, so that an integration which is stored and resumed makes the same steps.

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace endoflow::boundary_integral {

// One attempted step: F and dF/dy may use what was computed for the predicted state. What depends smoothly on y then
// needs one evaluation for each step instead of one for each iteration: the prediction is as accurate as the step.
struct StiffProblem {
    std::function<void(const Eigen::VectorXd& predicted)> begin_step;
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> rate;
    std::function<Eigen::MatrixXd()> jacobian;  // at the state of the last call of `rate`
    Eigen::VectorXd error_scales;               // absolute error per component that counts as one
};

struct StepLimits {
    double largest = 0.0;   // us
    double smallest = 0.0;  // us; a smaller step is a failure
};

struct StepHistory {
    static constexpr int highest_order = 5;

    double time = 0.0;
    double step = 0.0;            // of the next step, us
    int order = 1;                // of the next step
    int equal_steps = 0;          // made with this step and order
    Eigen::MatrixXd differences;  // size x (highest_order + 3): backward differences of y at `time`, order 0 is y

    // At the beginning: order 1, with y' from F(y).
    static StepHistory start(double time, double step, const Eigen::VectorXd& y, const Eigen::VectorXd& rate);
};

class StiffIntegrator {
  public:
    StiffIntegrator(StiffProblem problem, StepHistory history, const StepLimits& limits);

    // One step of the integrator's own choice, never beyond `end`. Exceptions in the problem's functions count as a
    // failed step; when a smaller step does not help, SolverError("step-size-underflow") tells the last of them.
    void advance(double end);

    const StepHistory& history() const { return history_; }
    double time() const { return history_.time; }
    Eigen::VectorXd state() const { return history_.differences.col(0); }
    double last_step() const { return last_step_; }
    int last_order() const { return last_order_; }

    // Interpolated inside the last step, to the integrator's order.
    Eigen::VectorXd state_at(double time) const;

    // The time inside the last step when `quantity` falls below `level`; nothing when it does not.
    std::optional<double> falls_below(const std::function<double(const Eigen::VectorXd&)>& quantity,
                                      double level) const;

    struct Statistics {
        long steps = 0, rates = 0, jacobians = 0, error_test_failures = 0, convergence_failures = 0;
    };
    const Statistics& statistics() const { return statistics_; }

  private:
    struct Correction {
        Eigen::VectorXd difference;  // accepted state minus predicted state
        int iterations = 0;
    };

    StiffProblem problem_;
    StepHistory history_;
    StepLimits limits_;
    double last_step_ = 0.0;
    int last_order_ = 1;
    Statistics statistics_;

    void scale_step(double factor);
    std::optional<Correction> correct(const Eigen::VectorXd& predicted);
    double norm(const Eigen::VectorXd& difference) const;
    void accept(const Correction& correction);
    void choose_order_and_step(const Correction& correction);
};

}  // namespace endoflow::boundary_integral
