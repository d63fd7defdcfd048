// Closed vesicles in free space.

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/driver/clearance.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "run_steps.h"
#include "shared/geometry/observables.h"
#include "shared/support/error.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// Reduced volume 0.94.
Parameters vesicle(double epsilon) {
    Parameters p;
    p.domain.kind = DomainKind::free_space;
    p.domain.spheroid_polar_axis = 30;
    p.domain.spheroid_equatorial_axis = 18;
    p.membrane.bending_stiffness_coated = p.membrane.bending_stiffness;
    p.membrane.spontaneous_curvature = 0;
    p.molecules.patch_radius = 1000;
    p.phase_field.epsilon = epsilon;
    p.phase_field.cell_size = cell_per_epsilon * epsilon;
    return p;
}

/// Of the first steps [pN nm/µs].
double first_dissipation(const Parameters& p) {
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    return scheme.attempt(0, 1e-5).diagnostics.viscous_dissipation;
}

}  // namespace

TEST_CASE("a vesicle's first motion is the sharp one's to second order", "[production]") {
    constexpr double sharp = 324.54;  // boundary-integral engine, at 1e-5 µs
    const auto uniform = [](double epsilon) {
        Parameters p = vesicle(epsilon);
        p.phase_field.production.thinning = 0;
        return p;
    };
    const double coarse = first_dissipation(uniform(2.4)), fine = first_dissipation(uniform(1.7));
    const double thin = first_dissipation(vesicle(1.7));
    CAPTURE(coarse, fine, thin);
    CHECK(std::log(std::abs(coarse / sharp - 1) / std::abs(fine / sharp - 1)) / std::log(2.4 / 1.7) > 1.7);
    // The poles' radius of curvature is 10.8 nm: (ε/10.8 nm)² = 2.5 %, times 4.5.
    CHECK(fine == Approx(sharp).epsilon(0.12));
    CHECK(thin == Approx(sharp).epsilon(0.01));  // 0.4 % measured
}

TEST_CASE("a vesicle keeps its area, its volume and its place", "[production]") {
    Parameters p = vesicle(2.4);
    p.time.initial_step = 2e-4;
    constexpr double end = 0.004;
    const BendingModel model(p.membrane);
    ProductionScheme scheme(p, MPI_COMM_SELF);
    StepOutcome last = scheme.start();
    const Spheroid spheroid = initial_spheroid(p.domain);
    const Observables first = measure(last.contour.curve, model);
    // The contour of an interpolated distance on cells of 3.2 nm.
    CHECK(first.membrane_area == Approx(spheroid.area()).epsilon(1e-6));
    CHECK(first.extracellular_volume == Approx(spheroid.volume()).epsilon(1e-6));
    double time = 0;
    while (time < end * (1 - 1e-12)) {
        last = take_step(scheme, time, end);
    }
    const MembraneCurve& curve = last.contour.curve;
    CHECK(last.contour.components == 1);
    CHECK(curve.closed());
    CHECK(curve.r.front() == 0);
    CHECK(curve.z.front() > curve.z.back());
    const Observables now = measure(curve, model);
    CHECK(now.bud_height < first.bud_height - 0.05);
    // A layer a quarter as thick as the poles' radius of curvature: measured 1e-7 and 1e-5.
    CHECK(now.membrane_area == Approx(first.membrane_area).epsilon(1e-6));
    CHECK(now.extracellular_volume == Approx(first.extracellular_volume).epsilon(1e-4));
    // Nothing but the mesh tells up from down.
    CHECK(0.5 * (curve.z.front() + curve.z.back()) == Approx(p.domain.membrane_height).margin(1e-5));
    CHECK(std::abs(last.diagnostics.net_vertical_force) < 1e-3);
    CHECK(last.diagnostics.extracellular_inflow == Approx(0).margin(1e-9));
}

TEST_CASE("a vesicle that comes near the walls of its box ends the run", "[production]") {
    Parameters p = vesicle(2.4);
    const MembraneCurve curve = InitialMembrane(p).curve(1);
    CHECK_NOTHROW(require_clearance(curve, p, 0));
    p.domain.membrane_height += 7 * 30 - 1;  // the box goes with it, the curve does not
    CHECK_THROWS_AS(require_clearance(curve, p, 0), SolverError);
}
