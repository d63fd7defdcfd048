#include "boundary_integral/integration/stiff_integrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "boundary_integral/integration/cvode_failures.h"
#include "boundary_integral/integration/lapack_solver.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int most_failures = 20;  // of one step, by its error or by its iteration

}  // namespace

StiffIntegrator::StiffIntegrator(StiffProblem problem, const StartingPoint& start, const StepLimits& limits)
    : problem_(std::move(problem)),
      time_(start.time),
      y_(new_vector(start.y.size(), context_)),
      matrix_(new_square_matrix(start.y.size(), context_)),
      solver_(lapack_solver(context_, reason_)),
      cvode_(CVodeCreate(CV_BDF, context_)) {
    if (!y_ || !matrix_ || !cvode_) require_success(CV_MEM_FAIL, "CVodeCreate");
    values_of(y_.get()) = start.y;
    set_up(start, limits);
}

void StiffIntegrator::set_up(const StartingPoint& start, const StepLimits& limits) {
    void* const cvode = cvode_.get();
    const auto rate = [](sunrealtype t, N_Vector y, N_Vector ydot, void* self) {
        return static_cast<StiffIntegrator*>(self)->rate(t, y, ydot);
    };
    const auto jacobian = [](sunrealtype, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector,
                             N_Vector) { return static_cast<StiffIntegrator*>(self)->jacobian(y, matrix); };
    const auto weigh = [](N_Vector, N_Vector weights, void* self) {
        values_of(weights) = static_cast<StiffIntegrator*>(self)->allowed_errors().cwiseInverse();
        return 0;
    };
    require_success(CVodeInit(cvode, rate, start.time, y_.get()), "CVodeInit");
    require_success(note_errors(cvode, context_, reason_), "the error handler");
    require_success(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    require_success(CVodeWFtolerances(cvode, weigh), "CVodeWFtolerances");
    require_success(CVodeSetLinearSolver(cvode, solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
    require_success(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
    require_success(CVodeSetLSetupFrequency(cvode, 1), "CVodeSetLSetupFrequency");
    require_success(CVodeSetJacEvalFrequency(cvode, 1), "CVodeSetJacEvalFrequency");
    require_success(CVodeSetMaxErrTestFails(cvode, most_failures), "CVodeSetMaxErrTestFails");
    require_success(CVodeSetMaxConvFails(cvode, most_failures), "CVodeSetMaxConvFails");
    require_success(CVodeSetNonlinConvCoef(cvode, limits.iteration), "CVodeSetNonlinConvCoef");
    require_success(CVodeSetMinStep(cvode, limits.smallest), "CVodeSetMinStep");
    require_success(CVodeSetMaxStep(cvode, limits.largest), "CVodeSetMaxStep");
    require_success(CVodeSetInitStep(cvode, std::min(start.step, limits.largest)), "CVodeSetInitStep");
}

template <class Work>
int StiffIntegrator::guarded(const Work& work) {
    constexpr int recoverable = 1, final = -1;
    try {
        work();
        return 0;
    } catch (const SolverError& error) {
        reason_ = error.what();
        return recoverable;
    } catch (...) {
        carried_ = std::current_exception();
        return final;
    }
}

int StiffIntegrator::rate(double time, N_Vector y, N_Vector rate) {
    return guarded([&] {
        rated_ = values_of(y);
        if (begun_ != time) {
            begun_.reset();
            ++statistics_.steps_begun;
            problem_.begin_step(rated_);
            begun_ = time;
        }
        ++statistics_.rates;
        values_of(rate) = problem_.rate(time, rated_);
        if (!values_of(rate).allFinite())
            throw SolverError("not-finite", "the rate of change is not finite", "report this case");
    });
}

int StiffIntegrator::jacobian(N_Vector y, SUNMatrix matrix) {
    return guarded([&] {
        if (rated_ != values_of(y)) throw std::logic_error("CVODE asks for a Jacobian at a state without a rate");
        ++statistics_.jacobians;
        values_of(matrix) = problem_.jacobian();
    });
}

void StiffIntegrator::advance(double end) {
    void* const cvode = cvode_.get();
    reason_.clear();
    require_success(CVodeSetStopTime(cvode, end), "CVodeSetStopTime");
    const int flag = CVode(cvode, end, y_.get(), &time_, CV_ONE_STEP);
    long error_test_failures = 0, convergence_failures = 0;
    require_success(CVodeGetNumErrTestFails(cvode, &error_test_failures), "CVodeGetNumErrTestFails");
    require_success(CVodeGetNumNonlinSolvConvFails(cvode, &convergence_failures), "CVodeGetNumNonlinSolvConvFails");
    statistics_.error_test_failures = error_test_failures_before_ + error_test_failures;
    statistics_.convergence_failures = convergence_failures_before_ + convergence_failures;
    if (carried_) std::rethrow_exception(std::exchange(carried_, nullptr));
    if (flag < 0) throw_cvode_failure(flag, time_, reason_);
    require_success(CVodeGetLastStep(cvode, &last_step_), "CVodeGetLastStep");
    require_success(CVodeGetLastOrder(cvode, &last_order_), "CVodeGetLastOrder");
    ++statistics_.steps;
    ++statistics_.steps_of_order.at(static_cast<std::size_t>(last_order_));
}

StiffIntegrator::Statistics& StiffIntegrator::Statistics::operator+=(const Statistics& other) {
    steps += other.steps;
    steps_begun += other.steps_begun;
    rates += other.rates;
    jacobians += other.jacobians;
    error_test_failures += other.error_test_failures;
    convergence_failures += other.convergence_failures;
    std::transform(steps_of_order.begin(), steps_of_order.end(), other.steps_of_order.begin(), steps_of_order.begin(),
                   std::plus<>());
    return *this;
}

StartingPoint StiffIntegrator::start_anew() {
    return start_from(time_, first_step());
}

StartingPoint StiffIntegrator::start_anew_at(double time, double first) {
    values_of(y_.get()) = state_at(time);
    time_ = time;
    return start_from(time, first);
}

/// From y_ on.
StartingPoint StiffIntegrator::start_from(double time, double first) {
    StartingPoint start{time, first, state()};
    error_test_failures_before_ = statistics_.error_test_failures;
    convergence_failures_before_ = statistics_.convergence_failures;
    begun_.reset();  // a resumed integration begins a step for the first rate, too
    require_success(CVodeReInit(cvode_.get(), start.time, y_.get()), "CVodeReInit");
    require_success(CVodeSetInitStep(cvode_.get(), start.step), "CVodeSetInitStep");
    return start;
}

/// h with ½ h² |y''| = ¼ in units of the tolerance, y'' from the interpolant.
double StiffIntegrator::first_step() const {
    if (last_order_ < 2) return last_step_;
    const Eigen::VectorXd scaled = derivative(time_, 2).cwiseQuotient(allowed_errors());
    const double size = scaled.norm() / std::sqrt(static_cast<double>(scaled.size()));
    return size > 0.0 ? std::min(last_step_, std::sqrt(0.5 / size)) : last_step_;
}

Eigen::VectorXd StiffIntegrator::allowed_errors() const {
    return problem_.allowed_part(time_) * problem_.error_scales;
}

Eigen::VectorXd StiffIntegrator::derivative(double time, int order) const {
    Eigen::VectorXd result(NV_LENGTH_S(y_.get()));
    const VectorHandle view = view_of(result, context_);
    require_success(CVodeGetDky(cvode_.get(), time, order, view.get()), "CVodeGetDky");
    return result;
}

Eigen::VectorXd StiffIntegrator::state_at(double time) const {
    return time < time_ ? derivative(time, 0) : state();
}

}  // namespace endoflow::boundary_integral
