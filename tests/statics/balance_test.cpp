// Force balances of the sampled shape, with derivatives and tension that owe nothing to the solver's equations.

#include <catch2/catch.hpp>

#include "default_rule.h"
#include "shared/geometry/axisymmetric_spline.h"
#include "statics/sampled_curve.h"
#include "statics/stationary_state.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

/// A shape's forces at its samples, from r(s), z(s), c(s) and κ(s) alone.
struct Forces {
    std::vector<double> vertical;   // on the part above the cut, over 2πr, pN/nm
    std::vector<double> magnitude;  // of what cancels in it
    std::vector<double> tension;    // from (A.17), tangential: dλ/ds = −(∂e/∂c) dc/ds, λ(rim) = 0
};

Forces forces_of(const MembraneCurve& curve, const MembraneEnergy& energy) {
    const std::size_t n = curve.size();
    const AxisymmetricSpline r(curve.s, curve.r, Parity::odd), z(curve.s, curve.z, Parity::even),
        c(curve.s, curve.c, Parity::even);
    std::vector<double> moment(n);
    for (std::size_t i = 0; i < n; ++i)
        moment[i] = energy.density(curve.kappa[i], curve.c[i], 0).partial[local::curvature];
    const AxisymmetricSpline m(curve.s, moment, Parity::even);

    Forces forces{std::vector<double>(n, 0), std::vector<double>(n, 0), std::vector<double>(n, 0)};
    const AxisymmetricSpline kappa(curve.s, curve.kappa, Parity::even);
    const auto tension_slope = [&](double s) {
        return -energy.density(kappa.value(s), c.value(s), 0).partial[local::concentration] * c.derivative(s);
    };
    for (std::size_t i = n - 1; i > 0; --i) {
        const double h = curve.s[i] - curve.s[i - 1];
        forces.tension[i - 1] =
            forces.tension[i] -
            h / 6 *
                (tension_slope(curve.s[i - 1]) + 4 * tension_slope(curve.s[i] - 0.5 * h) + tension_slope(curve.s[i]));
    }
    for (std::size_t i = 1; i < n; ++i) {
        const double s = curve.s[i], cosine = r.derivative(s), sine = -z.derivative(s);
        const double hoop = sine / curve.r[i], meridional = curve.kappa[i] - hoop;
        const double density = energy.density(curve.kappa[i], curve.c[i], 0).value;
        const double along = forces.tension[i] + density - moment[i] * meridional;  // along the meridian
        const double across = m.derivative(s);                                      // along the normal
        forces.vertical[i] = across * cosine - along * sine;
        forces.magnitude[i] = std::abs(across * cosine) + std::abs(along * sine);
    }
    return forces;
}

}  // namespace

TEST_CASE("No vertical force acts on any horizontal cut, and the tension is the first integral", "[statics]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 24;
    parameters.molecules.transport = GENERATE(Transport::advection, Transport::cahn_hilliard);
    const auto state = find_stationary_state(parameters);
    const MembraneCurve curve = sampled_curve(parameters, state.point.solution, default_rule, 4001);
    const Forces forces = forces_of(curve, membrane_energy(parameters));
    const double scale = *std::max_element(forces.magnitude.begin(), forces.magnitude.end());
    const double largest_tension = *std::max_element(curve.lambda.begin(), curve.lambda.end());
    REQUIRE(scale > 1e-3);  // pN/nm
    double worst_force = 0, worst_tension = 0;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
        worst_force = std::max(worst_force, std::abs(forces.vertical[i]));
        worst_tension = std::max(worst_tension, std::abs(forces.tension[i] - curve.lambda[i]));
    }
    CAPTURE(scale, worst_force, worst_tension, largest_tension);
    CHECK(worst_force < 1e-5 * scale);
    CHECK(worst_tension < 1e-5 * largest_tension);
}
