#include "boundary_integral/simulation.h"

#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <Eigen/Core>

#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/run_loop.h"
#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/support/parallel.h"
#include "shared/geometry/initial_curve.h"
#include "shared/model/exchange.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

void require_offered(const Parameters& parameters) {
    if (parameters.fluid.inertia) {
        throw InputError("fluid.inertia: the boundary-integral engine solves the Stokes equations; set it to false");
    }
    require_no_bulk(parameters, "boundary-integral");
    require_deformable(parameters);
}

EngineIdentity identity(const Parameters& parameters) {
    EngineIdentity identity;
    identity.name = "boundary-integral";
    identity.threads = thread_count(parameters.boundary_integral.threads);
    identity.libraries = {
        {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
        {"sundials", SUNDIALS_VERSION}};
    identity.history_columns = texts_of(own_history_columns());
    return identity;
}

ExitReason simulate(const Parameters& parameters, RunOutput& output) {
    require_offered(parameters);
    hold_blas_to_one_thread();
    Run run(parameters, output);
    std::optional<ExitReason> reason;
    while (!reason) reason = run.step();
    return *reason;
}

}  // namespace endoflow::boundary_integral
