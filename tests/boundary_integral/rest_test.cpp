// Membranes that do not move: no alarm, long steps, and as many threads as there are cores to use.

#include <sched.h>

#include <cstdlib>

#include "boundary_integral/support/parallel.h"
#include "runs.h"

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

namespace {

/// Runs a case that is at rest from the start, and looks for alarms and motion.
void check_rest(Parameters parameters, const std::string& name) {
    const ScratchDirectory scratch(name);
    parameters.time.end = 10;
    parameters.output.field_interval = 0;
    CHECK(run(parameters, scratch.path) == ExitReason::done);
    CHECK(record_of(scratch.path)["alarms"].empty());
    const Table history = read_table(scratch.path / "history.csv");
    for (const auto& row : history) {
        CHECK(std::abs(row.at("inflow_nm_per_us")) < 4e-5);               // 10⁻⁶ of the standard case's
        CHECK(std::abs(row.at("dissipated_power_pN_nm_per_us")) < 1e-6);  // 10⁻¹³ of it
    }
}

Parameters nearly_sphere(double polar, double equatorial) {
    Parameters parameters = standard(40, 10);
    parameters.domain.kind = DomainKind::free_space;
    parameters.domain.spheroid_polar_axis = polar;
    parameters.domain.spheroid_equatorial_axis = equatorial;
    parameters.membrane.bending_stiffness = parameters.membrane.bending_stiffness_coated = 100;
    parameters.membrane.spontaneous_curvature = 0;
    parameters.molecules.patch_radius = 1000;
    return parameters;
}

}  // namespace

TEST_CASE("a flat membrane without spontaneous curvature stays at rest without an alarm", "[run]") {
    Parameters parameters = standard(36, 10);
    parameters.membrane.spontaneous_curvature = 0;
    check_rest(parameters, "rest-flat");
    parameters.membrane.bending_stiffness_coated = parameters.membrane.bending_stiffness;  // a coat that does nothing
    check_rest(parameters, "rest-bare");
}

TEST_CASE("a vesicle that is nearly a sphere stays at rest without an alarm", "[run]") {
    check_rest(nearly_sphere(50, 50.0001), "rest-oblate");
    check_rest(nearly_sphere(50.0001, 50), "rest-prolate");
}

TEST_CASE("steps of a membrane at rest are as long as their error allows, and lead to the same state", "[run]") {
    const auto state_with = [](double longest) {
        const ScratchDirectory scratch("rest-steps");
        Parameters parameters = standard(36, 300);
        parameters.molecules.patch_radius = 20;
        parameters.output.field_interval = 0;
        parameters.output.shape_interval = 100;
        parameters.time.max_step = longest;
        CHECK(run(parameters, scratch.path) == ExitReason::done);
        CHECK(record_of(scratch.path)["alarms"].empty());
        return read_table(scratch.path / "history.csv");
    };
    const Table free = state_with(0), bounded = state_with(2);
    CHECK(free.back().at("step_us") > 10);
    CHECK(free.size() + 50 < bounded.size());
    // Both are at rest to what the steps' tolerance leaves, 10⁻⁴ nm: in the energy, a minimum, its square.
    for (const char* column : {"bending_energy_pN_nm", "bud_height_nm"})
        CHECK(free.back().at(column) == Approx(bounded.back().at(column)).epsilon(1e-8));
}

TEST_CASE("threads are as many as the process may use cores, at most OMP_NUM_THREADS", "[threads]") {
    const char* const before = std::getenv("OMP_NUM_THREADS");
    const std::string kept = before == nullptr ? "" : before;
    unsetenv("OMP_NUM_THREADS");
    cpu_set_t all, one;
    REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
    CHECK(thread_count(0) == CPU_COUNT(&all));
    CHECK(thread_count(3) == 3);
    for (const char* limit : {"1", "1,4"}) {
        setenv("OMP_NUM_THREADS", limit, 1);
        CHECK(thread_count(0) == 1);
        CHECK(thread_count(3) == 3);  // who names a number gets it
    }
    for (const char* nonsense : {"", "many", "-2", "0"}) {
        setenv("OMP_NUM_THREADS", nonsense, 1);
        CHECK(thread_count(0) == CPU_COUNT(&all));
    }
    unsetenv("OMP_NUM_THREADS");
    CPU_ZERO(&one);
    for (int core = 0; core < CPU_SETSIZE; ++core) {
        if (!CPU_ISSET(core, &all)) continue;
        CPU_SET(core, &one);
        break;
    }
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    CHECK(thread_count(0) == 1);
    REQUIRE(sched_setaffinity(0, sizeof all, &all) == 0);
    if (before != nullptr) setenv("OMP_NUM_THREADS", kept.c_str(), 1);
}
