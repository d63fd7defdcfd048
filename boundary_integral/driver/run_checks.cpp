#include "boundary_integral/driver/run_checks.h"

#include <fmt/format.h>

#include "shared/case/resolution.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

// Of the fewest elements across the coat's edge. With fewer c overshoots by tenths; with more by the hundredths of a
// resolved edge, and a law that does not stand them is to blame.
constexpr double overshooting_part = 0.25;

}  // namespace

void check_stiffness(const std::vector<double>& concentrations, const BendingModel& model, const Parameters& parameters,
                     double time) {
    for (const double c : concentrations) {
        if (model.stiffness(c).value > 0.0) continue;
        if (elements_per_edge_width(parameters) < overshooting_part * fewest_elements_per_edge_width)
            throw SolverError(
                "unresolved-coat-edge",
                fmt::format("c = {:.6f} at t = {:.6f} µs, where the bending stiffness is no longer "
                            "positive, beside the coat's edge: boundary_integral.elements = {} do not "
                            "resolve molecules.interface_width = {:g} nm",
                            c, time, parameters.boundary_integral.elements, parameters.molecules.interface_width),
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
