// The flow in the box: balances, reciprocity of the mobility, and the linear relaxation of a flat membrane.

#include <catch2/catch.hpp>
#include <numbers>

#include "boundary_integral/flow/box_flow.h"
#include "curves.h"
#include "shared/model/bending_model.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;

struct Solved {
    MembraneSamples samples;
    MobilityOperators operators;
    FlowSolution flow;
};

Solved solve(const Parameters& parameters, const MembraneSpace& space, const BoxFlow& box, const MembraneState& state) {
    Solved solved{sample(space, state), {}, {}};
    solved.operators = box.operators(state, solved.samples);
    solved.flow = box.solve(solved.operators, solved.samples,
                            energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first),
                            energy_density_at_rim(space, state, membrane_energy(parameters)));
    return solved;
}

}  // namespace

TEST_CASE("forces, fluxes and areas of a bulged membrane balance", "[flow]") {
    const Parameters parameters;
    const MembraneSpace space(48, 8);
    const BoxFlow box(parameters, space);
    const Solved solved = solve(parameters, space, box, bulge(space, 30));
    const FlowBalances balances = flow_balances(space, box, solved.operators, solved.samples, solved.flow);
    CHECK(balances.force < 1e-10);    // membrane + band; the quadrature's own accuracy
    CHECK(balances.area < 1e-10);     // the constraint holds against the constant
    CHECK(balances.net_flux < 1e-3);  // an arbitrary shape starts with a kink of u at the rim: first order there
    CHECK(solved.flow.power > 0);
    CHECK(std::abs(solved.flow.inflow) > 1);
}

TEST_CASE("the mobility is reciprocal", "[flow]") {
    // For the true operator l1.M l2 = l2.M l1 (Lorentz); ours is a collocation, so equality measures its accuracy.
    const Parameters parameters;
    const auto asymmetry = [&](Index elements) {
        const MembraneSpace space(elements, 8);
        const BoxFlow box(parameters, space);
        const MembraneState state = bulge(space, 30);
        const MembraneSamples samples = sample(space, state);
        const MobilityOperators operators = box.operators(state, samples);
        // Loads of two smooth force densities that vanish at the rim.
        const auto load = [&](const Profile& radial, const Profile& axial) -> Eigen::VectorXd {
            Eigen::VectorXd force(space.force_count());
            force << spline_of(space.radial(), radial), spline_of(space.force(), axial);
            return operators.freedoms.restrict_rows(force_mass_matrix(space, samples)) * force;
        };
        const Eigen::VectorXd one =
            load([](double x) { return x * std::pow(1 - x * x, 3); }, [](double x) { return std::pow(1 - x * x, 4); });
        const Eigen::VectorXd two = load([](double x) { return std::sin(3 * x) * std::pow(1 - x * x, 3); },
                                         [](double x) { return std::cos(4 * x) * std::pow(1 - x * x, 4); });
        const double there = one.dot(operators.mobility * two), back = two.dot(operators.mobility * one);
        return std::abs(there - back) / std::abs(there);
    };
    const double coarse = asymmetry(16), fine = asymmetry(48);
    CAPTURE(coarse, fine);
    // Second order, from the rim: there these forces bend u logarithmically, and the clamp replaces two equations.
    CHECK(fine < 5e-4);
    CHECK(coarse / fine > 6);
}

TEST_CASE("a small dent in the flat membrane relaxes at beta q^3 / (2 (nu1 + nu2))", "[flow]") {
    // z = A exp(-r^2 / (2 s^2)) has the spectrum A s^2 exp(-q^2 s^2/2); each ripple J0(q r) decays at its own rate, so
    //     u_z(r) = - beta / (2 (nu1 + nu2)) A s^2 int q^4 exp(-q^2 s^2 / 2) J0(q r) dq.
    Parameters parameters;
    const double width = 4, amplitude = 1e-4;  // nm; linear to (A/s)^2 = 1e-9, box effects ~ (s/R)^3 = 1e-4
    const MembraneSpace space(64, 8);
    const BoxFlow box(parameters, space);
    const MembraneState state = state_of(
        space, [](double x) { return 80 * x; },
        [&](double x) { return 80 + amplitude * std::exp(-0.5 * std::pow(80 * x / width, 2)); },
        [](double) { return 0.0; });
    const Solved solved = solve(parameters, space, box, state);
    const double beta = BendingModel(parameters.membrane).stiffness(0).value;
    const double scale = beta * amplitude * width * width /
                         (2 * (parameters.fluid.viscosity_extracellular + parameters.fluid.viscosity_intracellular));
    const Eigen::VectorXd u_z = solved.flow.velocity.tail(space.axial_count());
    for (const double r : {0.0, 2.0, 4.0, 8.0}) {
        double integral = 0;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {  // midpoint rule to q = 12/s, spectrally accurate for this integrand
            const double q = (i + 0.5) * 12 / width / count;
            integral += std::pow(q, 4) * std::exp(-0.5 * q * q * width * width) * std::cyl_bessel_j(0, q * r) * 12 /
                        width / count;
        }
        const double ours = space.axial().basis(r / 80).evaluate(u_z);
        CAPTURE(r, ours, -scale * integral);
        CHECK(std::abs(ours + scale * integral) < 1e-3 * scale * 3 * std::sqrt(pi / 2) / std::pow(width, 5));
    }
}
