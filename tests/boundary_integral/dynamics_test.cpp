// The membrane as a system of ordinary differential equations: conservation, Jacobian, energy balance.

#include <catch2/catch.hpp>

#include "boundary_integral/evolution/observation.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;

Parameters small_case() {
    Parameters parameters;
    parameters.boundary_integral.elements = 24;
    return parameters;
}

// A state some way into the motion, by explicit Euler steps that an unstiff observer would call tiny.
Eigen::VectorXd moved(const MembraneDynamics& dynamics) {
    Eigen::VectorXd y = dynamics.initial_vector();
    for (int i = 0; i < 3; ++i) y += 1e-7 * dynamics.evaluate(y).rate;
    return y;
}

}  // namespace

TEST_CASE("the initial membrane is flat, resolves the coat and holds its molecules", "[dynamics]") {
    Parameters parameters;
    parameters.boundary_integral.elements = 60;
    const MembraneDynamics dynamics(parameters);
    const Eigen::VectorXd y = dynamics.initial_vector();
    const MembraneState state = dynamics.unpack(y);
    const ShapeIntegrals shape = shape_integrals(dynamics.space(), state, DomainParameters{});
    CHECK(shape.area == Approx(std::acos(-1.0) * 80 * 80).epsilon(1e-12));
    // int c dA of the tanh profile: pi r_c^2 (1 + pi^2 (sqrt2 eps)^2 / (12 r_c^2)), up to exp(-2 r_c / (sqrt2 eps)) =
    // 4e-19.
    const double width = std::sqrt(2.0) * 1.2, patch = 36, pi = std::acos(-1.0);
    // 1e-6: what 60 elements resolve of a 1.7 nm wide edge
    CHECK(shape.mass ==
          Approx(pi * patch * patch * (1 + pi * pi * width * width / (12 * patch * patch))).epsilon(1e-6));
}

TEST_CASE("the molecules' mass does not change", "[dynamics]") {
    const auto law = GENERATE(Transport::cahn_hilliard, Transport::fickian, Transport::advection);
    Parameters parameters = small_case();
    parameters.molecules.transport = law;
    const MembraneDynamics dynamics(parameters);
    const Evaluation e = dynamics.evaluate(moved(dynamics));
    const Eigen::VectorXd rate = e.rate.tail(dynamics.space().axial_count());
    // The sum over the moments telescopes; only round-off is left of rates of this size.
    CHECK(std::abs(rate.sum()) < 1e-12 * rate.cwiseAbs().sum());
}

TEST_CASE("the energy's rate is minus the dissipated power plus diffusion", "[dynamics]") {
    const MembraneDynamics dynamics(small_case());
    const EnergyBalance balance = energy_balance(dynamics, dynamics.evaluate(moved(dynamics)));
    CHECK(balance.dissipated_power > 0);
    CHECK(balance.energy_rate < 0);
    CHECK(balance.residual() < 1e-4);  // mesh motion is no motion: interpolation error of the moving coat edge
}

TEST_CASE("the Jacobian is the derivative of the rate up to the frozen operators", "[dynamics]") {
    const MembraneDynamics dynamics(small_case());
    const Eigen::VectorXd y = dynamics.initial_vector();
    const Eigen::VectorXd scales = dynamics.error_scales(y, 1, 1);
    const Eigen::MatrixXd jacobian =
        scales.cwiseInverse().asDiagonal() * dynamics.jacobian(dynamics.evaluate(y)) * scales.asDiagonal();
    Eigen::MatrixXd difference(dynamics.size(), dynamics.size());
    for (Index j = 0; j < dynamics.size(); ++j) {
        const double step = 1e-6 * scales[j];
        Eigen::VectorXd up = y, down = y;
        up[j] += step;
        down[j] -= step;
        difference.col(j) = (dynamics.evaluate(up).rate - dynamics.evaluate(down).rate).cwiseQuotient(scales) / 2e-6;
    }
    const Index curve = dynamics.size() - dynamics.space().axial_count();
    const Index moments = dynamics.space().axial_count();
    const auto relative = [&](Index i, Index j, Index rows, Index columns) {
        return (jacobian - difference).block(i, j, rows, columns).norm() / difference.block(i, j, rows, columns).norm();
    };
    // Molecules by molecules has no boundary integrals in it: exact but for the relaxation of the mesh with the coat.
    CHECK(relative(curve, curve, moments, moments) < 1e-4);
    CHECK(relative(curve, 0, moments, curve) < 1e-2);
    CHECK(relative(0, 0, curve, curve) < 2e-2);
    CHECK(relative(0, curve, curve, moments) < 2e-2);
}
