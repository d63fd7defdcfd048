#include "boundary_integral/evolution/refinement.h"

#include <algorithm>
#include <limits>

#include "boundary_integral/evolution/resolution_estimate.h"
#include "shared/case/resolution.h"

namespace endoflow::boundary_integral {

namespace {

// Parts of the accuracy asked for: what is left when elements are added in time, and what the coat's edge may take at
// the start, for it gets coarser when the membrane flows in. Of the bound of the energy's balance: at a neck of 4 nm it
// grows fivefold in a step.
constexpr double allowed_part = 0.5, initial_part = 0.01, balance_part = 0.2;

// Four elements for three: the jumps fall to a sixth, the errors to a thirtieth. Where errors do not even fall to a
// half, there is a kink: the edge of a patch as narrow as the edge itself has a slope at the axis. Molecules that
// spread smooth it at once, and no number of elements does.
constexpr double least_fall = 0.5;

Index more(Index elements) {
    return std::min<Index>((4 * elements + 2) / 3, most_elements);
}

}  // namespace

std::unique_ptr<MembraneDynamics> dynamics_with(const Parameters& parameters, Index elements) {
    Parameters with = parameters;
    with.boundary_integral.elements = static_cast<int>(elements);
    return std::make_unique<MembraneDynamics>(with);
}

Index initial_elements(const Parameters& parameters) {
    if (parameters.boundary_integral.elements > 0) return parameters.boundary_integral.elements;
    const double accuracy = accuracy_of_elements(parameters);
    double before = std::numeric_limits<double>::infinity();
    for (Index elements = elements_asked_for(parameters);; elements = more(elements)) {
        if (elements == most_elements) return elements;
        const auto dynamics = dynamics_with(parameters, elements);
        const MembraneState state = dynamics->unpack(dynamics->initial_vector());
        const double error = estimate_resolution(dynamics->space(), state).relative_error();
        const bool kink = error > least_fall * before;
        if (error <= (kink ? allowed_part : initial_part) * accuracy) return elements;
        before = error;
    }
}

Index elements_for(const MembraneSpace& space, const MembraneState& state, double accuracy, double balance,
                   double balance_bound) {
    const bool enough = balance <= balance_part * balance_bound &&
                        estimate_resolution(space, state).relative_error() <= allowed_part * accuracy;
    return enough ? space.elements() : std::max(space.elements(), more(space.elements()));
}

Eigen::VectorXd transferred(const MembraneDynamics& from, const Eigen::VectorXd& y, const MembraneDynamics& to) {
    const MembraneState state = from.unpack(y);
    const auto values = [](const SplineSpace& spline, const Eigen::VectorXd& coefficients,
                           const std::vector<double>& points) {
        std::vector<double> found;
        for (const double xi : points) found.push_back(spline.basis(xi).evaluate(coefficients));
        return found;
    };
    const SplineSpace &radial = to.space().radial(), &axial = to.space().axial();
    const std::vector<double> axial_points = axial.greville_points();
    const Interpolation axial_interpolation(axial);
    MembraneState moved;
    moved.r = interpolate(radial, values(from.space().radial(), state.r, radial.greville_points()));
    moved.z = axial_interpolation(values(from.space().axial(), state.z, axial_points));
    moved.c = axial_interpolation(values(from.space().axial(), state.c, axial_points));
    Eigen::VectorXd result = to.packed(moved);
    // The interpolated c on the interpolated curve is some 1e-9 of the molecules off.
    const double before = y.tail(from.space().axial_count()).sum();
    auto moments = result.tail(to.space().axial_count());
    if (const double after = moments.sum(); after > 0.0) moments *= before / after;
    return result;
}

}  // namespace endoflow::boundary_integral
