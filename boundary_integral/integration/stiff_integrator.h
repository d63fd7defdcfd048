#pragma once

#include <Eigen/Core>
#include <array>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "boundary_integral/integration/sundials_handles.h"

namespace endoflow::boundary_integral {

/// y' = F(t, y), stiff. F and ∂F/∂y of one attempted step may use what was computed for its predicted state: what
/// depends smoothly on y needs one evaluation for each step then, not one for each iteration. The prediction is as
/// accurate as the step, so the order is kept. A SolverError in these functions costs a smaller step; any other
/// exception ends the integration.
struct StiffProblem {
    std::function<void(const Eigen::VectorXd& predicted)> begin_step;
    std::function<Eigen::VectorXd(double time, const Eigen::VectorXd& y)> rate;  ///< F(t, y), per µs
    std::function<Eigen::MatrixXd()> jacobian;  ///< ∂F/∂y at the state of the last call of `rate`
    Eigen::VectorXd error_scales;               ///< absolute error that counts as one, by component
    std::function<double(double time)> allowed_part = [](double) { return 1.0; };  ///< of these, for a step from there
};

/// A smaller step [µs] is a failure.
inline constexpr double smallest_step = 1e-14;

struct StepLimits {
    double largest = std::numeric_limits<double>::infinity();  ///< µs
    double smallest = smallest_step;
    double iteration = 0.1;  ///< error that the iteration may leave, in units of the step's; 0.1 is CVODE's own
};

/// All that an integration which starts anew depends on: one that starts from the same point makes the same steps.
struct StartingPoint {
    double time = 0.0;  ///< µs
    double step = 0.0;  ///< first step, µs
    Eigen::VectorXd y;
};

/// Variable-order, variable-step BDF of orders 1 to 5 with Newton's iteration: SUNDIALS' CVODE on LAPACK. The iteration
/// matrix is made anew for each step from the exact Jacobian. CVODE asks for the rate at a new time first at the
/// predicted state: that is when a step begins.
///
/// CVODE cannot store its history. So whoever wants to resume an integration exactly lets it start anew at fixed
/// numbers of steps, and resumes from the last such point.
class StiffIntegrator {
  public:
    StiffIntegrator(StiffProblem problem, const StartingPoint& start, const StepLimits& limits);
    ~StiffIntegrator() = default;
    StiffIntegrator(const StiffIntegrator&) = delete;  // CVODE holds its address
    StiffIntegrator& operator=(const StiffIntegrator&) = delete;

    /// One step of CVODE's own choice, never beyond `end`. Throws the SolverError that CVODE's failure stands for, or
    /// what the problem's functions threw.
    void advance(double end);

    /// Forgets all history: goes on at order 1, with a first step whose error is a quarter of the tolerance.
    /// Returns where from.
    [[nodiscard]] StartingPoint start_anew();

    /// The same from a time inside the last step on, where F becomes another one, with a first step of `first` [µs].
    [[nodiscard]] StartingPoint start_anew_at(double time, double first);

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] Eigen::VectorXd state() const { return values_of(y_.get()); }
    [[nodiscard]] double last_step() const { return last_step_; }
    [[nodiscard]] int last_order() const { return last_order_; }

    /// Interpolated inside the last step, to the integrator's order; at its end state().
    [[nodiscard]] Eigen::VectorXd state_at(double time) const;

    struct Statistics {
        long steps = 0, steps_begun = 0, rates = 0, jacobians = 0, error_test_failures = 0, convergence_failures = 0;
        std::array<long, 6> steps_of_order{};

        /// Adds those of an integration that went before.
        Statistics& operator+=(const Statistics& other);
    };
    /// Of the whole integration, whatever points it was started anew from.
    [[nodiscard]] const Statistics& statistics() const { return statistics_; }

  private:
    StiffProblem problem_;
    std::string reason_;           // what made the last attempt fail
    std::exception_ptr carried_;   // what must not be taken for a failed step
    std::optional<double> begun_;  // time for which a step has been begun, µs
    Eigen::VectorXd rated_;        // state of the last call of problem_.rate
    Statistics statistics_;
    long error_test_failures_before_ = 0, convergence_failures_before_ = 0;  // before the last start
    double time_, last_step_ = 0.0;
    int last_order_ = 1;
    sundials::Context context_;
    VectorHandle y_;
    MatrixHandle matrix_;
    LinearSolverHandle solver_;
    CvodeHandle cvode_;  // destroyed before what it uses

    void set_up(const StartingPoint& start, const StepLimits& limits);
    [[nodiscard]] StartingPoint start_from(double time, double first);
    [[nodiscard]] double first_step() const;
    [[nodiscard]] Eigen::VectorXd derivative(double time, int order) const;
    template <class Work>
    [[nodiscard]] int guarded(const Work& work);
    [[nodiscard]] int rate(double time, N_Vector y, N_Vector rate);
    [[nodiscard]] int jacobian(N_Vector y, SUNMatrix matrix);
    [[nodiscard]] Eigen::VectorXd allowed_errors() const;  // of a step from time_
};

}  // namespace endoflow::boundary_integral
