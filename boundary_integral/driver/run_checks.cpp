#include "boundary_integral/driver/run_checks.h"

#include <fmt/format.h>

#include "boundary_integral/evolution/resolution_estimate.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

/// Jump of c's fifth derivative from which on c overshoots by tenths. Below it, it does by the hundredths of a resolved
/// edge, and a law that does not stand them is to blame.
constexpr double unresolved = 2.0;

}  // namespace

void check_stiffness(const Evaluation& evaluation, const MembraneDynamics& dynamics, const Parameters& parameters,
                     double time) {
    for (const double c : evaluation.samples.c) {
        if (dynamics.model().stiffness(c).value > 0.0) continue;
        if (estimate_resolution(dynamics.space(), evaluation.state).concentration > unresolved)
            throw SolverError("unresolved-coat-edge",
                              fmt::format("c = {:.6f} at t = {:.6f} µs, where the bending stiffness is no longer "
                                          "positive, beside the coat's edge: boundary_integral.elements = {} do not "
                                          "resolve molecules.interface_width = {:g} nm",
                                          c, time, dynamics.space().elements(), parameters.molecules.interface_width),
                              "raise one of them");
        throw SolverError("negative-stiffness",
                          fmt::format("the law of membrane.constitutive_law gives no positive bending stiffness at "
                                      "c = {:.6f}, beside the edge of the coat, at t = {:.6f} µs",
                                      c, time),
                          "bring membrane.bending_stiffness and bending_stiffness_coated nearer to each other, or "
                          "choose another membrane.constitutive_law");
    }
}

}  // namespace endoflow::boundary_integral
