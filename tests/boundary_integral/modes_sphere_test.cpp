// Shape modes of a spherical, inextensible, closed membrane: a sphere does not know the axis, so that the rate of the
// harmonic (l, m) is that of (l, 0), known in closed form (verification_sphere_modes has the formula and its source).

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/modes/linearised_membrane.h"
#include "curves.h"
#include "modes_states.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

double published_rate(double inner, double outer, double stiffness, double sigma, double l) {
    const double friction = inner * (l - 1) * (2 * l * l + 5 * l + 5) + outer * (l + 2) * (2 * l * l - l + 2);
    return stiffness / std::pow(sphere_radius, 3) * (l - 1) * l * (l + 1) * (l + 2) * (l * (l + 1) + sigma) / friction;
}

}  // namespace

TEST_CASE("rates of a sphere's harmonics (l, m) do not depend on m", "[modes]") {
    const double outer = GENERATE(1e-4, 1e-3, 1e-2);
    const double sigma = GENERATE(0.0, 7.0);
    const Parameters parameters = vesicle_parameters(1e-3, outer);
    const MembraneSpace space(32, 8, CurveEnd::closed);
    const BendingModel model(parameters.membrane);
    const Surroundings surroundings(parameters, space, 5);
    const LinearisedMembrane membrane(parameters, surroundings, sphere_at_rest(space, model, sigma));
    for (int mode = 1; mode <= 5; ++mode) {
        const ModeRates rates = membrane.rates(mode);
        const Eigen::MatrixXd block = rates.material.topLeftCorner(rates.displacements, rates.displacements);
        const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(block, false).eigenvalues();
        Eigen::VectorXd decay = -values.real();
        std::sort(decay.begin(), decay.end());
        CAPTURE(outer, sigma, mode, decay.head(6).transpose(), values.imag().cwiseAbs().maxCoeff());
        Index next = mode == 1 ? 1 : 0;  // l = 1 is a translation
        const double slowest = published_rate(1e-3, outer, model.stiffness(0).value, sigma, std::max(mode, 2));
        if (mode == 1) CHECK(std::abs(decay[0]) < 1e-8 * slowest);
        for (int l = std::max(mode, 2); l <= 5; ++l, ++next) {
            const double exact = published_rate(1e-3, outer, model.stiffness(0).value, sigma, l);
            CHECK(decay[next] == Approx(exact).epsilon(1e-5));
        }
    }
}
