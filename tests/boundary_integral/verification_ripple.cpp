// Relaxation of ripples on the flat membrane in the box: rate(q) = beta q^3 / (2 (nu1 + nu2)), from the balance of the
// force beta q^4 z with the normal response 2 (nu1 + nu2) q of two half-spaces whose interface moves normally.
//
// The box has no ripple of a single wave number that respects its clamp, so the test takes packets
//     z = A J0(q r) exp(-r^2 / (2 L^2)),    Z(k) = int z J0(k r) r dr = A L^2 exp(-(q^2 + k^2) L^2 / 2) I0(q k L^2),
// whose ripples lie within some 1/L of q, and superposes their rates. They fade out well inside the rim and push the
// fluid with no net force (k^4 Z(k) vanishes at k = 0), so the box and its walls have no part in the answer.

#include <catch2/catch.hpp>
#include <cmath>

#include "boundary_integral/flow/box_flow.h"
#include "curves.h"
#include "shared/model/bending_model.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

constexpr double envelope = 11;  // L, nm: exp(-R^2 / (2 L^2)) = 3e-12 at the rim

double bending_stiffness(const Parameters& parameters) {
    return BendingModel(parameters.membrane).stiffness(0).value;
}

double sum_of_viscosities(const Parameters& parameters) {
    return parameters.fluid.viscosity_extracellular + parameters.fluid.viscosity_intracellular;
}

// -u_z/z on the axis by the linear theory, 1/us: the mean of rate(k) over the packet's spectrum k Z(k).
double exact_rate(const Parameters& parameters, double q) {
    const double square = envelope * envelope;
    double moment = 0, weight = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {  // midpoint rule, spectrally accurate for this integrand
        const double k = (i + 0.5) * (q + 12 / envelope) / count;
        const double argument = q * k * square;
        const double spectrum =
            k * std::exp(-0.5 * (q - k) * (q - k) * square - argument) * std::cyl_bessel_i(0, argument);
        weight += spectrum;
        moment += spectrum * std::pow(k, 3);
    }
    return bending_stiffness(parameters) * moment / weight / (2 * sum_of_viscosities(parameters));
}

// The same by the engine.
double computed_rate(const Parameters& parameters, double q, Index elements) {
    const double amplitude = 1e-4;  // nm; linear to (A q)^2 = 1e-8
    const double rim = parameters.domain.radius, level = parameters.domain.membrane_height;
    const MembraneSpace space(elements, 8);
    const BoxFlow box(parameters, space);
    const MembraneState state = state_of(
        space, [&](double x) { return rim * x; },
        [&](double x) {
            const double r = rim * x;
            return level + amplitude * std::cyl_bessel_j(0, q * r) * std::exp(-0.5 * r * r / (envelope * envelope));
        },
        [](double) { return 0.0; });
    const MembraneSamples samples = sample(space, state);
    const FlowSolution flow =
        box.solve(box.operators(state, samples), samples,
                  energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first),
                  energy_density_at_rim(space, state, membrane_energy(parameters)));
    return -space.axial().basis(0).evaluate(Eigen::VectorXd(flow.velocity.tail(space.axial_count()))) / amplitude;
}

}  // namespace

TEST_CASE("ripples on the flat membrane relax at beta q^3 / (2 (nu1 + nu2))", "[verification]") {
    Parameters parameters;
    parameters.fluid.viscosity_intracellular = GENERATE(1e-3, 1e-2);
    for (const double q : {0.3, 0.6, 1.2}) {
        const double exact = exact_rate(parameters, q);
        const double coarse = std::abs(computed_rate(parameters, q, 48) / exact - 1);
        const double fine = std::abs(computed_rate(parameters, q, 96) / exact - 1);
        CAPTURE(parameters.fluid.viscosity_intracellular, q, exact, coarse, fine);
        // A force is a fourth derivative of the shape. Quintic splines in the energy, which has second ones, give
        // order 4.
        CHECK(std::log2(coarse / fine) > 3.5);
        CHECK(fine < 3e-4 * std::pow(q / 1.2, 3));
    }
}
