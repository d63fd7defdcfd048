#pragma once

#include <catch2/catch.hpp>

#include "phasefield/schemes/production/production_scheme.h"

namespace endoflow::phasefield::production {

/// A step towards `end` µs, which may not be repeated; the mesh follows and `time` moves on.
inline StepOutcome take_step(ProductionScheme& scheme, double& time, double end) {
    const double tau = scheme.step(time, end);
    StepOutcome outcome = scheme.attempt(time, tau);
    REQUIRE(outcome.rejection.empty());
    scheme.keep(time, tau, outcome);
    scheme.follow(outcome.contour.curve);
    time += tau;
    return outcome;
}

/// Steps to `end` µs, none of which may be repeated; calls visit(time, tau, outcome) after each.
template <class Visit>
void run_steps(ProductionScheme& scheme, double end, const Visit& visit) {
    double time = 0;
    while (time < end * (1 - 1e-12)) {
        const double before = time;
        const StepOutcome outcome = take_step(scheme, time, end);
        visit(time, time - before, outcome);
    }
}

}  // namespace endoflow::phasefield::production
