// What the mesh's changes leave as it was.

#include <catch2/catch.hpp>
#include <set>

#include "one_step.h"
#include "run_steps.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

TEST_CASE("molecules are conserved when the mesh and the layer's thickness change", "[production]") {
    // Each solution of the past keeps its own integral: with one factor for all, what the others' integrals were off by
    // was a source.
    Parameters p = small_case();
    p.molecules.patch_radius = 10;             // bends more strongly
    p.phase_field.production.thinning = 1.42;  // 20 nm
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    const double mass = scheme.integrate().molecules;
    double time = 0;
    const double cells = scheme.cells();
    while (scheme.cells() == cells) {
        REQUIRE(time < 0.02);
        take_step(scheme, time, 1);
    }
    CHECK(scheme.integrate().molecules == Approx(mass).epsilon(1e-7));
}

TEST_CASE("the rim is held alike whatever the mesh", "[production]") {
    std::set<dealii::types::global_dof_index> held;
    for (const double band_width : {4.5, 8.0}) {
        Parameters p = small_case();
        p.phase_field.band_width = band_width;
        held.insert(OneStep(p).space.constraints.n_constraints());
    }
    CHECK(held.size() == 1);
}
