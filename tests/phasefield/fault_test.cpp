// Faults put into the linear systems and the step control: each is survived or ends in an error with a name.

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "../shared/temporary_directory.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/simulation.h"
#include "phasefield/solver/linear_system.h"
#include "shared/output/atomic_file.h"
#include "shared/output/run_directory.h"
#include "shared/output/run_files.h"
#include "shared/support/error.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A scalar space on a small mesh with its linear system.
struct ScalarProblem {
    ScalarProblem() : mesh(coarse_mesh(small_case(), MPI_COMM_SELF)), space(*mesh, {1}), system(MPI_COMM_SELF, "test") {
        space.distribute();
        space.constraints.close();
        Couplings full(1, 1);
        full.fill(dealii::DoFTools::always);
        system.reinit(space, full);
    }

    /// The solution of diagonal · x = right_hand_side, entry by entry.
    double solve(double diagonal, double right_hand_side) {
        system.start();
        for (const auto i : space.owned) {
            system.matrix.add(i, i, diagonal);
            system.right_hand_side(i) += right_hand_side;
        }
        Vector solution = space.vector();
        system.solve(space.constraints, solution);
        return solution.linfty_norm();
    }

    std::string failure(double diagonal, double right_hand_side) {
        try {
            solve(diagonal, right_hand_side);
        } catch (const SolverError& error) {
            return error.name();
        }
        return "none";
    }

    std::unique_ptr<Mesh> mesh;
    Space space;
    LinearSystem system;
};

Parameters short_run() {
    Parameters p = small_case();
    p.phase_field.scheme = PhaseFieldScheme::paper;
    p.molecules.patch_radius = 20;
    p.phase_field.epsilon = p.phase_field.cell_size = p.molecules.interface_width = 4;
    p.time.initial_step = 1e-5;
    p.time.end = 3e-5;
    return p;
}

}  // namespace

TEST_CASE("a linear system survives not-a-numbers and singular matrices", "[faults]") {
    ScalarProblem problem;
    CHECK(problem.solve(2, 3) == Approx(1.5).epsilon(1e-14));
    CHECK(problem.failure(2, not_a_number) == "not-a-number");
    CHECK(problem.failure(0, 3) == "linear-solver");
    CHECK(problem.failure(not_a_number, 3) == "linear-solver");
    CHECK(problem.failure(std::numeric_limits<double>::infinity(), 3) == "linear-solver");
    // The next good system is solved as if nothing had happened, and so is one far from the last factors.
    CHECK(problem.solve(4, 3) == Approx(0.75).epsilon(1e-14));
    CHECK(problem.solve(1e9, 3) == Approx(3e-9).epsilon(1e-14));
}

TEST_CASE("rejected steps in a row end in a run that goes on", "[faults]") {
    const TemporaryDirectory scratch;
    Parameters p = short_run();
    p.phase_field.paper.max_motion = 1e-3;  // nm: a step of 1e-5 µs moves the membrane farther
    RunFiles output(p, identity(1), scratch.path() / "run", StartMode::fresh);
    CHECK(simulate(p, output, MPI_COMM_SELF) == ExitReason::done);
    output.finish(ExitReason::done);
    const std::string record = read_file(RunDirectory{scratch.path() / "run"}.record(), 1 << 20);
    CHECK(record.find("\"rejected\": 0") == std::string::npos);
}

TEST_CASE("with the sign of Sec. 3 energy comes from nowhere, which is an error with a name", "[faults]") {
    const TemporaryDirectory scratch;
    Parameters p = short_run();
    p.phase_field.paper.force_sign = ForceSign::minus;
    p.phase_field.paper.step_rule = StepRule::ramp;
    p.time.end = 1;
    RunFiles output(p, identity(1), scratch.path() / "run", StartMode::fresh);
    try {
        simulate(p, output, MPI_COMM_SELF);
        FAIL("the energy cannot grow for ever");
    } catch (const SolverError& error) {
        CHECK(error.name() == "energy-law");
    }
}

TEST_CASE("steps that are always rejected end in an error with a name, and no row is written", "[faults]") {
    const TemporaryDirectory scratch;
    Parameters p = short_run();
    p.phase_field.paper.max_motion = 1e-12;
    RunFiles output(p, identity(1), scratch.path() / "run", StartMode::fresh);
    try {
        simulate(p, output, MPI_COMM_SELF);
        FAIL("no step can be that small");
    } catch (const SolverError& error) {
        CHECK(error.name() == "step-size-underflow");
    }
    const std::string history = read_file(RunDirectory{scratch.path() / "run"}.history(), 1 << 20);
    CHECK(std::count(history.begin(), history.end(), '\n') == 2);  // names and the initial state
}
