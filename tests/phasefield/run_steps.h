#pragma once

#include <catch2/catch.hpp>

#include "phasefield/schemes/production/production_scheme.h"

namespace endoflow::phasefield::production {

/// Steps to `end` µs, none of which may be repeated; calls visit(time, tau, outcome) after each.
template <class Visit>
void run_steps(ProductionScheme& scheme, double end, const Visit& visit) {
    double time = 0;
    while (time < end * (1 - 1e-12)) {
        const double tau = scheme.step(time, end);
        const StepOutcome outcome = scheme.attempt(time, tau);
        REQUIRE(outcome.rejection.empty());
        scheme.keep(time, tau, outcome);
        scheme.follow(outcome.contour.curve);
        time += tau;
        visit(time, tau, outcome);
    }
}

}  // namespace endoflow::phasefield::production
