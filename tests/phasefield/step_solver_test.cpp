// Newton's method with the factors of earlier steps.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "../shared/temporary_directory.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "phasefield/solver/anderson.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

void keep_steps(ProductionScheme& scheme, double& time, int count, double tau) {
    for (int k = 0; k < count; ++k) {
        const auto outcome = scheme.attempt(time, tau);
        REQUIRE(outcome.rejection.empty());
        scheme.keep(time, tau, outcome);
        time += tau;
    }
}

/// The small case with a wider band of fine cells: with the default one cells of 10 nm begin 4.2 ε from the membrane,
/// where first factors of single precision do not serve, and those of double precision follow.
Parameters well_conditioned_case() {
    Parameters p = small_case();
    p.phase_field.band_width = 4.5;
    return p;
}

struct Seen {
    double height, energy, dissipation;
};

Seen seen(const StepOutcome& outcome) {
    return {outcome.contour.curve.z.front(), outcome.diagnostics.bending_energy,
            outcome.diagnostics.viscous_dissipation};
}

}  // namespace

TEST_CASE("Anderson's acceleration finds the directions in which the iteration fails", "[newton]") {
    const auto mesh = coarse_mesh(small_case(), MPI_COMM_SELF);
    Space space(*mesh, {1, 2});
    space.distribute();
    space.constraints.close();
    // d(x) = a (b − x) for each unknown: the plain iteration multiplies errors by 1 − a.
    const auto rate = [](unsigned int i) { return i % 97 == 3 ? 3.0 : i % 89 == 5 ? -1.0 : i % 83 == 7 ? 0.1 : 1.0; };
    const auto target = [](unsigned int i) { return std::sin(1.0 + i); };
    // Unknowns that jump about, and do not count.
    const auto jumps = [](unsigned int i) { return i % 71 == 11; };
    for (const bool with_jumps : {false, true}) {
        Vector x = space.vector(), increment = space.vector(), counted = space.vector();
        const auto distance = [&](int iteration) {
            double largest = 0;
            for (unsigned int i = 0; i < space.dofs.n_dofs(); ++i) {
                const bool counts = !with_jumps || !jumps(i);
                counted(i) = counts ? 1 : 0;
                increment(i) = counts ? rate(i) * (target(i) - x(i)) : std::cos(3.0 * iteration * i);
                if (counts) largest = std::max(largest, std::abs(target(i) - x(i)));
            }
            return largest;
        };
        distance(0);
        AndersonMixing mixing(space, {0, 0}, counted);
        // Four different rates: like GMRES, the method ends after as many changes, and one iteration to see the first.
        for (int k = 0; k < 5; ++k) {
            CHECK(distance(k) > 1e-6);
            mixing.advance(x, increment);
        }
        CHECK(distance(5) < 1e-10);
    }
}

TEST_CASE("a membrane at rest takes one factorisation and stays at rest", "[newton]") {
    // Flat, without spontaneous curvature, molecules that nothing moves: all changes are round-off, which does not
    // shrink from one iteration to the next.
    Parameters p = well_conditioned_case();
    p.membrane.spontaneous_curvature = 0;
    p.molecules.transport = Transport::advection;
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    double time = 0;
    keep_steps(scheme, time, 3, 2e-5);
    CHECK(scheme.factorisations() == 1);
    const auto outcome = scheme.attempt(time, 2e-5);
    CHECK(outcome.contour.curve.z.front() == Approx(p.domain.membrane_height).epsilon(1e-12));
    // Newton's method ends where the curvature is 1e-6/R: β/2 (1e-6/R)² on the area πR².
    CHECK(outcome.diagnostics.bending_energy < 1e-12 * std::numbers::pi / 2 * p.membrane.bending_stiffness);
}

TEST_CASE("a step with the factors of another one ends where its own factors lead", "[newton]") {
    constexpr double tau = 2e-5;
    std::vector<Seen> ends;
    double at_start = 0;
    for (const bool old_factors : {false, true}) {
        ProductionScheme scheme(well_conditioned_case(), MPI_COMM_SELF);
        at_start = scheme.start().diagnostics.bending_energy;
        if (old_factors) scheme.attempt(0, 1.1 * tau);
        const unsigned int before = scheme.factorisations();
        ends.push_back(seen(scheme.attempt(0, tau)));
        CHECK(scheme.factorisations() == before + (old_factors ? 0 : 1));
    }
    // Newton's method ends with changes below 4e-7 nm; the bud rises by 0.01 nm in this step.
    CHECK(ends[1].height == Approx(ends[0].height).margin(1e-6));
    // At the scale of the cells they change curvatures of 0.07/nm by 1e-7 to 1e-6, so the energy by some 1e-6 of
    // itself.
    CHECK(at_start - ends[1].energy == Approx(at_start - ends[0].energy).epsilon(1e-4));
    CHECK(ends[1].dissipation == Approx(ends[0].dissipation).epsilon(1e-4));
}

TEST_CASE("a run that is continued goes on within the tolerance of its steps", "[newton]") {
    const TemporaryDirectory directory;
    ProductionScheme scheme(small_case(), MPI_COMM_SELF), continued(small_case(), MPI_COMM_SELF);
    scheme.start();
    double time = 0;
    keep_steps(scheme, time, 3, 2e-5);
    Checkpoint checkpoint;
    scheme.save(directory.path() / "checkpoint", checkpoint);
    continued.load(directory.path() / "checkpoint", checkpoint);
    CHECK(continued.step(time, 1) == scheme.step(time, 1));
    const unsigned int before = scheme.factorisations();
    CHECK(continued.factorisations() == before);  // counts go on
    const Seen one = seen(scheme.attempt(time, 3e-5)), other = seen(continued.attempt(time, 3e-5));
    CHECK(scheme.factorisations() == before);  // else there would be nothing to compare
    CHECK(continued.factorisations() == before + 1);
    // As for old and new factors above.
    CHECK(other.height == Approx(one.height).margin(1e-6));
    CHECK(other.energy == Approx(one.energy).epsilon(1e-6));
    CHECK(other.dissipation == Approx(one.dissipation).epsilon(1e-4));
}
