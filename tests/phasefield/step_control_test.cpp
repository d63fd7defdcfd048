// Time step control, joining of contour pieces, distance from the walls: parts without finite elements.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "phasefield/contour/chain.h"
#include "phasefield/driver/clearance.h"
#include "phasefield/schemes/paper/step_control.h"
#include "phasefield/schemes/production/step_control.h"
#include "shared/model/time_scale.h"
#include "shared/support/error.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

TEST_CASE("a production step that ends early may have a smaller error", "[control]") {
    const Parameters p;
    const double T = structure_time(p);
    CHECK(early_part(0.125 * T, p) == Approx(0.5));
    CHECK(early_part(3 * T, p) == 1);
    CHECK(early_part(1e-9 * T, p) == 0.1);
    // The error over what is allowed is what the next step follows: 0.5^(1/4) of the length for half of it.
    production::TriedStep tried{.tau = 1e-3, .order = 3, .wrong_position = 2};
    tried.change = 1e3;
    const double half = production::step_after(tried, tried.tau, p);
    tried.wrong_position = 1;
    CHECK(half == Approx(std::pow(0.5, 0.25) * production::step_after(tried, tried.tau, p)));
}

TEST_CASE("the first production step is an eighth of the sharp engine's, unless a case says", "[control]") {
    Parameters p;
    CHECK(production::first_implicit_step(p) == Approx(first_step(p) / 8));
    p.time.initial_step = 1e-6;
    CHECK(production::first_implicit_step(p) == 1e-6);
}

TEST_CASE("the step doubles every ramp_steps steps up to its limit", "[control]") {
    Parameters p;
    p.time.initial_step = 1e-5;
    p.phase_field.paper.ramp_steps = 3;
    p.phase_field.paper.max_step = 3.5e-5;
    StepControl control(p);
    for (int i = 0; i < 2; ++i) control.accept(control.nominal, 0);
    CHECK(control.nominal == Approx(1e-5));
    control.accept(control.nominal, 0);
    CHECK(control.nominal == Approx(2e-5));
    for (int i = 0; i < 3; ++i) control.accept(control.nominal, 0);
    CHECK(control.nominal == Approx(3.5e-5));
}

TEST_CASE("a large motion shortens the step, a rejection halves it, and that ends in an error with a name",
          "[control]") {
    Parameters p;
    p.phase_field.paper.max_motion = 0.2;
    StepControl control(p);
    control.accept(1e-5, 0.32);  // twice what the safety factor 0.8 allows
    CHECK(control.nominal == Approx(0.5e-5));
    CHECK(control.too_far(0.21));
    CHECK(control.too_far(std::numeric_limits<double>::quiet_NaN()));
    control.reject(0.1);
    CHECK(control.nominal == Approx(0.25e-5));
    try {
        for (int i = 0; i < 100; ++i) control.reject(0.1);
        FAIL("no error");
    } catch (const SolverError& error) {
        CHECK(error.name() == "step-size-underflow");
    }
}

TEST_CASE("the printed ramp takes no notice of the membrane, and a step that fails ends the run", "[control]") {
    Parameters p;
    p.time.initial_step = 1e-5;
    p.phase_field.paper.step_rule = StepRule::ramp;
    p.phase_field.paper.ramp_steps = 2;
    StepControl control(p);
    CHECK_FALSE(control.too_far(1e6));
    CHECK(control.too_far(std::numeric_limits<double>::quiet_NaN()));
    for (int i = 0; i < 2; ++i) control.accept(control.nominal, 1e6);
    CHECK(control.nominal == Approx(2e-5));
    try {
        control.reject(0.1);
        FAIL("no error");
    } catch (const SolverError& error) {
        CHECK(error.name() == "printed-scheme-failed");
    }
}

TEST_CASE("a step ends at the deadline without a tiny last step", "[control]") {
    Parameters p;
    p.time.initial_step = 1e-3;
    const StepControl control(p);
    CHECK(control.step(0, 5e-3) == Approx(1e-3));
    CHECK(control.step(0, 0.7e-3) == Approx(0.7e-3));
    CHECK(control.step(0, 1.2e-3) == Approx(0.6e-3));
}

TEST_CASE("contour segments join to one chain whatever their order and direction", "[contour]") {
    const auto point = [](double r, double z) { return ContourPoint{r, z}; };
    const std::vector<ContourSegment> segments = {{point(2, 0), point(1, 1e-10)},
                                                  {point(0, 0), point(1, 0)},
                                                  {point(3, 0), point(2, -1e-10)},
                                                  {point(3, 0), point(3, 0)}};
    const auto chains = join_segments(segments, 1e-7);
    REQUIRE(chains.size() == 1);
    CHECK(chains[0].size() == 4);
    const auto thin = thin_out(chains[0], 1.5);
    REQUIRE(thin.size() == 2);
    CHECK(thin.back() == chains[0].back());
}

TEST_CASE("a membrane near a wall is an error; its rim is not", "[control]") {
    Parameters p;
    MembraneCurve curve;
    for (int i = 0; i <= 160; ++i) {
        curve.s.push_back(0.5 * i);
        curve.r.push_back(0.5 * i);
        curve.z.push_back(80);
    }
    CHECK_NOTHROW(require_clearance(curve, p, 0));
    curve.z[3] = p.domain.height - 0.5 * p.domain.wall_clearance;
    CHECK_THROWS_AS(require_clearance(curve, p, 0), SolverError);
}
