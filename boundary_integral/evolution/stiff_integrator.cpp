#include "boundary_integral/evolution/stiff_integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>
#include <exception>
#include <utility>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

using Map = Eigen::Map<Eigen::VectorXd>;

Map view(N_Vector v) {
    return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v))};
}

}  // namespace

struct StiffIntegrator::Implementation {
    StiffProblem problem;
    SUNContext context = nullptr;
    N_Vector y = nullptr;
    N_Vector scratch = nullptr;
    N_Vector tolerances = nullptr;
    SUNMatrix matrix = nullptr;
    SUNLinearSolver solver = nullptr;
    void* cvode = nullptr;
    double time = 0.0;
    double last_step = 0.0;
    Eigen::VectorXd state;
    std::string failure;

    ~Implementation() {
        if (cvode != nullptr) CVodeFree(&cvode);
        if (solver != nullptr) SUNLinSolFree(solver);
        if (matrix != nullptr) SUNMatDestroy(matrix);
        for (N_Vector v : {y, scratch, tolerances}) {
            if (v != nullptr) N_VDestroy(v);
        }
        if (context != nullptr) SUNContext_Free(&context);
    }

    // Calls `action`; any exception becomes a recoverable failure, so that the integrator tries a smaller step.
    template <class Action>
    int guarded(Action action) {
        try {
            action();
            return 0;
        } catch (const std::exception& error) {
            failure = error.what();
            return 1;
        }
    }

    static int rate(double t, N_Vector y, N_Vector rate, void* self) {
        auto& me = *static_cast<Implementation*>(self);
        return me.guarded([&] {
            const Eigen::VectorXd value = me.problem.rate(t, view(y));
            if (!value.allFinite()) throw SolverError("not-finite", "the rate of change is not finite", "");
            view(rate) = value;
        });
    }

    static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector, N_Vector) {
        auto& me = *static_cast<Implementation*>(self);
        return me.guarded([&] {
            const Eigen::VectorXd at = view(y);
            Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(matrix), at.size(), at.size()) = me.problem.jacobian(t, at);
        });
    }

    static int event(double, N_Vector y, double* value, void* self) {
        auto& me = *static_cast<Implementation*>(self);
        return me.guarded([&] { value[0] = me.problem.event(view(y)); });
    }

    static void ignore_message(int, const char*, const char*, char* message, void* self) {
        auto& me = *static_cast<Implementation*>(self);
        if (me.failure.empty()) me.failure = message;
    }

    void check(int flag, const char* what) {
        if (flag < 0) throw SolverError("time-integration", std::string(what) + " failed", "report this case");
    }
};

StiffIntegrator::StiffIntegrator(StiffProblem problem, double time, const Eigen::VectorXd& y, const StepLimits& limits)
    : implementation_(std::make_unique<Implementation>()) {
    Implementation& me = *implementation_;
    me.problem = std::move(problem);
    me.time = time;
    me.state = y;
    me.check(SUNContext_Create(nullptr, &me.context), "SUNContext_Create");
    const auto size = static_cast<sunindextype>(y.size());
    me.y = N_VNew_Serial(size, me.context);
    me.scratch = N_VNew_Serial(size, me.context);
    me.tolerances = N_VNew_Serial(size, me.context);
    me.matrix = SUNDenseMatrix(size, size, me.context);
    view(me.y) = y;
    view(me.tolerances) = me.problem.error_scales;
    me.solver = SUNLinSol_Dense(me.y, me.matrix, me.context);
    me.cvode = CVodeCreate(CV_BDF, me.context);
    me.check(CVodeInit(me.cvode, &Implementation::rate, time, me.y), "CVodeInit");
    me.check(CVodeSetUserData(me.cvode, &me), "CVodeSetUserData");
    me.check(CVodeSetErrHandlerFn(me.cvode, &Implementation::ignore_message, &me), "CVodeSetErrHandlerFn");
    me.check(CVodeSVtolerances(me.cvode, 0.0, me.tolerances), "CVodeSVtolerances");
    me.check(CVodeSetLinearSolver(me.cvode, me.solver, me.matrix), "CVodeSetLinearSolver");
    if (me.problem.jacobian) me.check(CVodeSetJacFn(me.cvode, &Implementation::jacobian), "CVodeSetJacFn");
    if (me.problem.event) me.check(CVodeRootInit(me.cvode, 1, &Implementation::event), "CVodeRootInit");
    me.check(CVodeSetNoInactiveRootWarn(me.cvode), "CVodeSetNoInactiveRootWarn");
    me.check(CVodeSetInitStep(me.cvode, limits.initial), "CVodeSetInitStep");
    me.check(CVodeSetMaxStep(me.cvode, limits.largest), "CVodeSetMaxStep");
    me.check(CVodeSetMinStep(me.cvode, limits.smallest), "CVodeSetMinStep");
    me.check(CVodeSetMaxErrTestFails(me.cvode, 20), "CVodeSetMaxErrTestFails");
    me.check(CVodeSetMaxConvFails(me.cvode, 40), "CVodeSetMaxConvFails");
    // A rate costs several Jacobians here, and the Jacobian is approximate: iterate tightly with fresh matrices. Left
    // at their defaults the iteration errors feed the error estimate and keep the order at 2 (measured: 30 % more
    // rates).
    me.check(CVodeSetNonlinConvCoef(me.cvode, 0.01), "CVodeSetNonlinConvCoef");
    me.check(CVodeSetMaxNonlinIters(me.cvode, 5), "CVodeSetMaxNonlinIters");
    me.check(CVodeSetLSetupFrequency(me.cvode, 5), "CVodeSetLSetupFrequency");
    me.check(CVodeSetJacEvalFrequency(me.cvode, 5), "CVodeSetJacEvalFrequency");
}

StiffIntegrator::~StiffIntegrator() = default;

StiffIntegrator::Outcome StiffIntegrator::advance(double end) {
    Implementation& me = *implementation_;
    me.failure.clear();
    me.check(CVodeSetStopTime(me.cvode, end), "CVodeSetStopTime");
    const double before = me.time;
    const int flag = CVode(me.cvode, end, me.y, &me.time, CV_ONE_STEP);
    if (flag < 0) {
        throw SolverError("step-size-underflow",
                          "no time step is small enough at t = " + std::to_string(me.time) + " us (" + me.failure + ")",
                          "use more elements, or a looser time.tolerance");
    }
    me.last_step = me.time - before;
    me.state = view(me.y);
    if (flag == CV_ROOT_RETURN) return Outcome::event;
    return flag == CV_TSTOP_RETURN ? Outcome::end : Outcome::step;
}

double StiffIntegrator::time() const {
    return implementation_->time;
}
double StiffIntegrator::last_step() const {
    return implementation_->last_step;
}
const Eigen::VectorXd& StiffIntegrator::state() const {
    return implementation_->state;
}

Eigen::VectorXd StiffIntegrator::state_at(double time) const {
    Implementation& me = *implementation_;
    me.check(CVodeGetDky(me.cvode, time, 0, me.scratch), "CVodeGetDky");
    return view(me.scratch);
}

StiffIntegrator::Statistics StiffIntegrator::statistics() const {
    Statistics s{};
    void* cvode = implementation_->cvode;
    CVodeGetNumSteps(cvode, &s.steps);
    CVodeGetNumRhsEvals(cvode, &s.rate_evaluations);
    CVodeGetNumJacEvals(cvode, &s.jacobians);
    CVodeGetNumErrTestFails(cvode, &s.error_test_failures);
    CVodeGetNumStepSolveFails(cvode, &s.convergence_failures);
    CVodeGetLastOrder(cvode, &s.order);
    return s;
}

}  // namespace endoflow::boundary_integral
