// A run in memory and step by step: the same rows as through a directory, stopped and continued or not.

#include "boundary_integral/driver/run_loop.h"
#include "runs.h"
#include "shared/output/run_memory.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral::testing;
using endoflow::boundary_integral::Run;

constexpr double end_of_memory_run = 1e-3;  // µs: a dozen steps, with restarts of the integrator between them

Parameters short_run() {
    Parameters parameters = standard(16, end_of_memory_run);
    parameters.boundary_integral.restart_interval = 4;
    return parameters;
}

}  // namespace

TEST_CASE("a run in memory has the rows and shapes of one in a directory", "[run]") {
    const ScratchDirectory scratch("memory");
    const Parameters parameters = short_run();
    run(parameters, scratch.path);
    const Table written = read_table(scratch.path / "history.csv");
    RunMemory memory(parameters, boundary_integral::identity(parameters));
    CHECK(boundary_integral::simulate(parameters, memory) == ExitReason::done);
    REQUIRE(memory.rows().size() == written.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
        CHECK(memory.rows()[i].time_us == Approx(written[i].at("time_us")).epsilon(1e-14));
        CHECK(memory.rows()[i].membrane.bud_height == Approx(written[i].at("bud_height_nm")).epsilon(1e-14));
    }
    CHECK(memory.shapes().back().time_us == end_of_memory_run);
}

TEST_CASE("a run that is asked to stop leaves a checkpoint that another goes on from as if it had not stopped",
          "[run]") {
    const Parameters parameters = short_run();
    RunMemory whole(parameters, boundary_integral::identity(parameters));
    CHECK(boundary_integral::simulate(parameters, whole) == ExitReason::done);

    RunMemory first(parameters, boundary_integral::identity(parameters));
    Run stopped(parameters, first);
    for (int i = 0; i < 6; ++i) CHECK_FALSE(stopped.step());
    CHECK(stopped.shape().z.front() > 0);
    first.request_stop();
    CHECK(stopped.step() == ExitReason::interrupted);
    REQUIRE(first.checkpoint());
    CHECK(first.checkpoint()->time_us > 0);

    RunMemory second(parameters, boundary_integral::identity(parameters), first.checkpoint());
    CHECK(boundary_integral::simulate(parameters, second) == ExitReason::done);
    CHECK(second.rows().back().membrane.bud_height == whole.rows().back().membrane.bud_height);
}
