#pragma once

// SUNDIALS CVODE (variable-order BDF) for y' = F(y) with a dense Jacobian, one step at a time, with dense output and an
// event.

#include <functional>
#include <memory>
#include <string>

#include <Eigen/Core>

namespace endoflow::boundary_integral {

struct StiffProblem {
    std::function<Eigen::VectorXd(double, const Eigen::VectorXd&)> rate;
    std::function<Eigen::MatrixXd(double, const Eigen::VectorXd&)> jacobian;
    std::function<double(const Eigen::VectorXd&)> event;  // a zero crossing stops a step there
    Eigen::VectorXd error_scales;                         // absolute error per component that counts as one
};

struct StepLimits {
    double initial = 0.0;   // us
    double largest = 0.0;   // us
    double smallest = 0.0;  // us; a smaller step is a failure
};

class StiffIntegrator {
  public:
    StiffIntegrator(StiffProblem problem, double time, const Eigen::VectorXd& y, const StepLimits& limits);
    ~StiffIntegrator();
    StiffIntegrator(const StiffIntegrator&) = delete;
    StiffIntegrator& operator=(const StiffIntegrator&) = delete;

    enum class Outcome { step, event, end };

    // One step of the integrator's own choice, never beyond `end`. Exceptions of F count as a failed step; when a
    // smaller step does not help the last of them is rethrown as a SolverError.
    Outcome advance(double end);

    double time() const;
    double last_step() const;
    const Eigen::VectorXd& state() const;
    // Interpolated inside the last step, to the integrator's order.
    Eigen::VectorXd state_at(double time) const;

    struct Statistics {
        long steps, rate_evaluations, jacobians, error_test_failures, convergence_failures;
        int order;
    };
    Statistics statistics() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace endoflow::boundary_integral
