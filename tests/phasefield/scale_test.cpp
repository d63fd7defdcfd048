// Problems that differ by their units alone have one solution: no number of the scheme carries a unit of its own.

#include <catch2/catch.hpp>

#include "phasefield/layer/initial_membrane.h"
#include "phasefield/make_scheme.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "shared/geometry/observables.h"
#include "shared/model/time_scale.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// Height, volume, area and energy of the membrane after some steps the scheme chooses itself, and the time reached.
struct Reached {
    double time = 0;
    Observables seen;
};

Reached after_steps(const Parameters& p, int steps) {
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    Reached out;
    Contour contour;
    for (int i = 0; i < steps; ++i) {
        const double tau = scheme.step(out.time, p.time.end);
        const auto outcome = scheme.attempt(out.time, tau);
        REQUIRE(outcome.rejection.empty());
        scheme.keep(out.time, tau, outcome);
        contour = outcome.contour;
        out.time += tau;
    }
    out.seen = measure(contour.curve, BendingModel(p.membrane));
    return out;
}

/// Newton's method ends at 2·10⁻² of what a step may have, a tenth of the tolerance so early: here 2·10⁻⁸ nm. The
/// volume is that of a mean displacement of 2·10⁻³ nm. A constant with a unit shows at 10⁻⁴ and more.
constexpr double solver = 1e-6, tolerance = 2e-6;

void check_equal(const Reached& a, const Reached& b, double time, double length) {
    CHECK(b.time == Approx(time * a.time).epsilon(1e-4));
    CHECK(b.seen.bud_height == Approx(length * a.seen.bud_height).epsilon(solver));
    CHECK(b.seen.extracellular_volume ==
          Approx(length * length * length * a.seen.extracellular_volume).epsilon(solver));
    CHECK(b.seen.membrane_area == Approx(length * length * a.seen.membrane_area).epsilon(solver));
    CHECK(b.seen.bending_energy == Approx(a.seen.bending_energy).epsilon(solver));
}

/// What a scale of lengths and one of times do to a case whose energies stay.
Parameters scaled(Parameters p, double length, double time) {
    for (double* nm : {&p.domain.radius, &p.domain.height, &p.domain.membrane_height, &p.domain.pin_half_width,
                       &p.domain.wall_clearance, &p.molecules.patch_radius, &p.molecules.interface_width,
                       &p.phase_field.epsilon, &p.phase_field.cell_size, &p.membrane.pole_force_width})
        *nm *= length;
    p.membrane.spontaneous_curvature /= length;
    for (double* pascal_second : {&p.fluid.viscosity_extracellular, &p.fluid.viscosity_intracellular})
        *pascal_second *= time / (length * length * length);
    for (double* diffusivity :
         {&p.molecules.diffusivity, &p.molecules.normal_diffusivity, &p.phase_field.stretching_diffusivity})
        *diffusivity *= length * length / time;
    p.molecules.mobility *= length * length * length / time;
    p.fluid.normal_mobility *= length * length * length * length / time;
    p.time.end *= time;
    p.time.initial_step *= time;
    return p;
}

}  // namespace

TEST_CASE("viscosities and times a hundred times as large change nothing", "[scale]") {
    for (const Transport transport : {Transport::cahn_hilliard, Transport::fickian}) {
        Parameters p = small_case();
        p.molecules.transport = transport;
        p.time.tolerance = tolerance;
        const int steps = 8;
        check_equal(after_steps(p, steps), after_steps(scaled(p, 1, 100), steps), 100, 1);
    }
}

TEST_CASE("lengths ten times as large with equal energies change nothing", "[scale]") {
    Parameters p = small_case();
    p.time.tolerance = tolerance;
    const int steps = 8;
    check_equal(after_steps(p, steps), after_steps(scaled(p, 10, 1000), steps), 1000, 10);
}

TEST_CASE("a problem mirrored in the rim's plane has the opposite height and volume", "[scale]") {
    Parameters p = small_case();
    p.time.tolerance = tolerance;
    Parameters mirrored = p;
    mirrored.membrane.spontaneous_curvature *= -1;
    std::swap(mirrored.fluid.viscosity_extracellular, mirrored.fluid.viscosity_intracellular);
    const int steps = 8;
    Reached a = after_steps(p, steps);
    CHECK(a.seen.bud_height > 0);
    a.seen.bud_height *= -1;
    a.seen.extracellular_volume *= -1;
    check_equal(a, after_steps(mirrored, steps), 1, 1);
}

TEST_CASE("a membrane at rest has the same points in other units, and so the same mesh", "[scale]") {
    // 80 nm are 200 quarters of a cell of 4/3 ε; in doubles 200.00000000000003 of them, ten times as large 200.
    const auto points = [](const Parameters& p) {
        return InitialMembrane(p).curve(0.25 * with_chosen_cells(p).phase_field.cell_size).size();
    };
    CHECK(points(Parameters{}) == 201);
    CHECK(points(scaled(Parameters{}, 10, 1000)) == 201);
}

TEST_CASE("first and longest steps are those of the standard case, or as given", "[scale]") {
    Parameters p;
    // Four digits of the printed 0.01 ns and of the former default.
    CHECK(first_step(p) == Approx(1e-5).epsilon(1e-4));
    CHECK(longest_step(p) == Approx(0.2).epsilon(1e-4));
    p.time.initial_step = 3e-5;
    p.time.max_step = 0.1;
    CHECK(first_step(p) == 3e-5);
    CHECK(longest_step(p) == 0.1);
}
