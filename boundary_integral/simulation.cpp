#include "boundary_integral/simulation.h"

#include <cblas.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <Eigen/Core>

#include "boundary_integral/driver/history_recorder.h"
#include "boundary_integral/driver/run_loop.h"
#include "boundary_integral/support/parallel.h"
#include "shared/geometry/initial_curve.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

void require_offered(const Parameters& parameters) {
    if (parameters.fluid.inertia) {
        throw InputError("fluid.inertia: the boundary-integral engine solves the Stokes equations; set it to false");
    }
    require_deformable(parameters);
}

}  // namespace

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
    // Our own threads share the work; those of OpenBLAS would only spin beside them on matrices of this size.
    openblas_set_num_threads(1);
    return run_to_end(parameters, output);
}

}  // namespace endoflow::boundary_integral
