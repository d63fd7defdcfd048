// The same numbers on two processes as on one. Run by mpirun.

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/contour/contour.h"
#include "phasefield/contour/parts_along.h"
#include "phasefield/layer/initial_membrane.h"
#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/paper/paper_step.h"
#include "phasefield/schemes/paper/state_files.h"
#include "phasefield/schemes/production/fields.h"
#include "shared/geometry/observables.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

namespace {

struct Outcome {
    double energy, volume, area, molecules, strain;
};

Outcome outcome(Discretization& d, const State& state) {
    const auto diagnostics = diagnose_step(d.spaces, state, state, 0, d.parameters);
    const auto observables = measure(extract_contour(contour_fields(d.spaces, state), d.parameters).curve,
                                     BendingModel(d.parameters.membrane));
    return {diagnostics.bending_energy, observables.extracellular_volume, observables.membrane_area,
            integrate_layer(d.spaces, state, d.parameters).molecules, diagnostics.area_strain_max};
}

Outcome short_run(MPI_Comm communicator) {
    Parameters p = small_case();
    p.phase_field.paper.profile_mobility = 300;
    Discretization d(p, communicator);
    State state = initial_state(d);
    for (int step = 0; step < 4; ++step) {
        state = advance(d, state, 2e-4);
        auto curve = positions(extract_contour(contour_fields(d.spaces, state), p).curve);
        for (auto& point : curve) point.z += 2.5 * (step == 1);
        adapt(d, state, curve);
    }
    return outcome(d, state);
}

}  // namespace

TEST_CASE("two processes give what one gives", "[mpi]") {
    const Outcome one = short_run(MPI_COMM_SELF), two = short_run(MPI_COMM_WORLD);
    // The linear solver stops at 1e-11; the smallest of these quantities is a thousandth of what it is made of.
    CHECK(two.energy == Approx(one.energy).epsilon(1e-8));
    CHECK(two.volume == Approx(one.volume).epsilon(1e-6));
    CHECK(two.area == Approx(one.area).epsilon(1e-9));
    CHECK(two.molecules == Approx(one.molecules).epsilon(1e-10));
    CHECK(two.strain == Approx(one.strain).epsilon(1e-6));
}

TEST_CASE("the mesh is cut along the membrane where its parts cost the same", "[mpi]") {
    const Parameters p = small_case();
    const auto mesh = coarse_mesh(p, MPI_COMM_WORLD);
    Space space(*mesh, production::field_degrees(p.phase_field));
    space.distribute();
    const auto share_of_first = [&](const std::vector<PartAlong>& last) {
        return measured_parts(parts_along(InitialMembrane(p).curve(1.0), space, last), 1, space).front().cells;
    };
    // Cells above one another have one place along the flat membrane: the share comes in columns.
    const double column = 1 / std::round(p.domain.radius / layer_cell_size(p) / 4);
    CHECK(share_of_first({}) == Approx(0.5).margin(column));
    CHECK(share_of_first({{0.5, 1}, {0.5, 3}}) == Approx(0.5 + 0.5 / 3).margin(column));
    CHECK(share_of_first({{0.2, 1}, {0.8, 1}}) == Approx(0.2).margin(column));
}

TEST_CASE("a checkpoint brings the state back, also on another number of processes", "[mpi]") {
    const auto directory = std::filesystem::temp_directory_path() /
                           ("endoflow_checkpoint_test_" + std::to_string(dealii::Utilities::MPI::broadcast(
                                                              MPI_COMM_WORLD, static_cast<int>(getpid()))));
    const Parameters p = small_case();
    Discretization d(p, MPI_COMM_WORLD);
    const State state = advance(d, initial_state(d), 2e-4);
    save_mesh_and_state(directory, d, state);
    const Outcome saved = outcome(d, state);

    for (const MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF}) {
        Discretization fresh(p, communicator);
        const State loaded = load_mesh_and_state(directory, fresh);
        const Outcome restored = outcome(fresh, loaded);
        CHECK(restored.energy == Approx(saved.energy).epsilon(1e-12));
        CHECK(restored.volume == Approx(saved.volume).epsilon(1e-9));
        CHECK(restored.molecules == Approx(saved.molecules).epsilon(1e-12));
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0) std::filesystem::remove_all(directory);
}
