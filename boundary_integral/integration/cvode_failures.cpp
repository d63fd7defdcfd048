#include "boundary_integral/integration/cvode_failures.h"

#include <cvode/cvode.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <memory>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

struct Failure {
    int flag;
    const char *name, *what, *remedy;
};

constexpr const char* no_small_step = "no time step is small enough";
constexpr const char* smoother = "lower boundary_integral.accuracy, or use a looser time.tolerance";
constexpr const char* broken_set_up = "the integrator refused how it was set up";
constexpr const char* report = "report this case";

constexpr std::array failures{
    Failure{CV_TOO_MUCH_WORK, "too-many-steps", "the integrator made its largest number of steps", smoother},
    Failure{CV_TOO_MUCH_ACC, "tolerance-too-small", "round-off is larger than the errors asked for",
            "raise time.tolerance"},
    Failure{CV_ERR_FAILURE, "step-size-underflow", no_small_step, smoother},
    Failure{CV_CONV_FAILURE, "step-size-underflow", no_small_step, smoother},
    Failure{CV_LINIT_FAIL, "integrator-set-up", broken_set_up, report},
    Failure{CV_LSETUP_FAIL, "singular-matrix", "the iteration matrix cannot be factored", smoother},
    Failure{CV_LSOLVE_FAIL, "singular-matrix", "the iteration matrix cannot be solved with", smoother},
    Failure{CV_RHSFUNC_FAIL, "no-rate", "the rate of change cannot be computed", report},
    Failure{CV_FIRST_RHSFUNC_ERR, "no-rate", "the rate of change cannot be computed where the integration starts",
            "check the initial shape and the domain"},
    Failure{CV_REPTD_RHSFUNC_ERR, "step-size-underflow", no_small_step, smoother},
    Failure{CV_UNREC_RHSFUNC_ERR, "no-rate", "the rate of change cannot be computed", smoother},
    Failure{CV_NLS_INIT_FAIL, "integrator-set-up", broken_set_up, report},
    Failure{CV_NLS_SETUP_FAIL, "singular-matrix", "the iteration cannot be set up", smoother},
    Failure{CV_NLS_FAIL, "no-convergence", "Newton's iteration ended without a result", smoother},
    Failure{CV_MEM_FAIL, "out-of-memory", "the integrator found no memory", "use fewer elements"},
    Failure{CV_TOO_CLOSE, "no-time-left", "time.end is too near to the present to be reached",
            "choose a later time.end"},
};

}  // namespace

void throw_cvode_failure(int flag, double time, const std::string& reason) {
    for (const Failure& failure : failures) {
        if (failure.flag != flag) continue;
        const std::string because = reason.empty() ? "" : " (" + reason + ")";
        throw SolverError(failure.name, fmt::format("{} at t = {:.9g} µs{}", failure.what, time, because),
                          failure.remedy);
    }
    const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
    throw SolverError("integrator-failed",
                      fmt::format("CVODE returned {} at t = {:.9g} µs ({})", name.get(), time, reason), report);
}

void require_success(int flag, const char* call) {
    if (flag >= 0) return;
    throw SolverError("integrator-set-up", fmt::format("{} of SUNDIALS returned {}", call, flag), report);
}

}  // namespace endoflow::boundary_integral
