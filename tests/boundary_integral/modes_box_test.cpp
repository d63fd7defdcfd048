// Modes of the membrane in the box: ripples of the flat membrane, which do not know the axis, and reciprocity.

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "boundary_integral/modes/linearised_membrane.h"
#include "curves.h"
#include "modes_states.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

// Packets J_m(q r) exp(-r^2/(2 L^2)), see verification_ripple: their transform of order m is
//     Z(k) = L^2 exp(-(q^2 + k^2) L^2/2) I_m(q k L^2).
constexpr double envelope = 11;  // nm

double packet(double q, int mode, double r) {
    return std::cyl_bessel_j(mode, q * r) * std::exp(-0.5 * r * r / (envelope * envelope));
}

// -dw/dt at r by the linear theory: each ripple decays with stiffness k^3/(2 (nu1 + nu2)).
double exact_rate(const Parameters& parameters, double stiffness, double q, int mode, double r) {
    const double square = envelope * envelope;
    double sum = 0;
    constexpr int count = 2000;
    const double step = (q + 12 / envelope) / count;
    for (int i = 0; i < count; ++i) {  // midpoint rule, spectrally accurate for this integrand
        const double k = (i + 0.5) * step, argument = q * k * square;
        sum += step * k * square * std::exp(-0.5 * (q - k) * (q - k) * square - argument) *
               std::cyl_bessel_i(mode, argument) * std::pow(k, 3) * std::cyl_bessel_j(mode, k * r);
    }
    return stiffness * sum /
           (2 * (parameters.fluid.viscosity_extracellular + parameters.fluid.viscosity_intracellular));
}

BaseState flat(const Parameters& parameters, const MembraneSpace& space) {
    return at_rest(space, state_of(
                              space, [&](double x) { return parameters.domain.radius * x; },
                              [&](double) { return parameters.domain.membrane_height; }, [](double) { return 0.0; }));
}

// Of the rate of one packet, relative to its largest value.
double largest_error(const Parameters& parameters, const LinearisedMembrane& membrane, const ModeSpace& space, double q,
                     double stiffness) {
    const SplineSpace& splines = space.vertical();
    const double rim = parameters.domain.radius;
    const Eigen::VectorXd values = spline_of(splines, [&](double x) { return packet(q, space.mode(), rim * x); });
    // Its coefficients in the mode's space, which holds it but for the approximation near the axis.
    const Eigen::MatrixXd expansion = space.displacement_expansion();
    const ModeRates rates = membrane.rates(space.mode());
    Eigen::VectorXd y = Eigen::VectorXd::Zero(rates.material.cols());
    y.head(rates.displacements) = (expansion.transpose() * expansion).ldlt().solve(expansion.transpose() * values);
    const Eigen::VectorXd rate = expansion * (rates.material * y).head(rates.displacements);
    double error = 0, scale = 0;
    for (int i = 0; i < 60; ++i) {
        const double x = i / 100.0;
        const double exact = exact_rate(parameters, stiffness, q, space.mode(), rim * x);
        error = std::max(error, std::abs(splines.basis(x).evaluate(rate) + exact));
        scale = std::max(scale, std::abs(exact));
    }
    return error / scale;
}

std::vector<double> largest_errors(const Parameters& parameters, double q, const std::vector<int>& modes,
                                   Index elements) {
    const MembraneSpace space(elements, 8);
    const BendingModel model(parameters.membrane);
    const Surroundings surroundings(parameters, space, modes.back());
    const LinearisedMembrane membrane(parameters, surroundings, flat(parameters, space));
    std::vector<double> errors;
    for (const int mode : modes) {
        errors.push_back(largest_error(parameters, membrane, surroundings.space(mode), q, model.stiffness(0).value));
    }
    return errors;
}

}  // namespace

TEST_CASE("ripples J_m(q r) cos(m phi) of the flat membrane relax at beta q^3 / (2 (nu1 + nu2))", "[modes]") {
    const Parameters parameters;
    const std::vector<int> modes = {0, 1, 2, 3, 5, 8};
    const std::vector<double> coarse = largest_errors(parameters, 0.6, modes, 48);
    const std::vector<double> fine = largest_errors(parameters, 0.6, modes, 96);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        CAPTURE(modes[i], coarse[i], fine[i]);
        // As for m = 0 a fourth derivative of quintic splines; near the axis J_5 is what they know least of.
        CHECK(fine[i] < 3e-4);
        CHECK(std::log2(coarse[i] / fine[i]) > 3);
    }
}

TEST_CASE("the mobility of every mode is reciprocal", "[modes]") {
    // l1.M l2 = l2.M l1 (Lorentz) for the true operator; ours is a collocation, so equality measures its accuracy.
    const Parameters parameters;
    const auto asymmetry = [&](int mode, Index elements) {
        const MembraneSpace space(elements, 8);
        const BendingModel model(parameters.membrane);
        const Surroundings surroundings(parameters, space, mode);
        const LinearisedMembrane membrane(parameters, surroundings, at_rest(space, bulge(space, 30)));
        const ModeSpace& mode_space = surroundings.space(mode);
        // Loads of two smooth force densities that vanish at the rim.
        const auto load = [&](const Profile& across, const Profile& along) {
            const auto lateral = [&](int power) {
                return spline_of(mode_space.lateral(), [&](double x) { return std::pow(x, power) * across(x); });
            };
            const Eigen::VectorXd first = lateral(mode - 1), second = lateral(mode + 1);
            Eigen::VectorXd force(mode_space.force_count());
            force << first + second, second - first,
                spline_of(mode_space.vertical_force(), [&](double x) { return std::pow(x, mode) * along(x); });
            return Eigen::VectorXd(mode_space.velocities().transpose() *
                                   (mode_forms(mode_space, membrane.points()).force_mass * force));
        };
        const Eigen::VectorXd one =
            load([](double x) { return std::pow(1 - x * x, 3); }, [](double x) { return std::pow(1 - x * x, 4); });
        const Eigen::VectorXd two = load([](double x) { return std::cos(3 * x) * std::pow(1 - x * x, 3); },
                                         [](double x) { return std::cos(4 * x) * std::pow(1 - x * x, 4); });
        const Eigen::MatrixXd mobility = membrane.rates(mode).mobility;
        const double there = one.dot(mobility * two), back = two.dot(mobility * one);
        return std::abs(there - back) / std::abs(there);
    };
    for (const int mode : {1, 2, 5}) {
        const double coarse = asymmetry(mode, 16), fine = asymmetry(mode, 48);
        CAPTURE(mode, coarse, fine);
        CHECK(fine < 5e-4);
        CHECK(coarse / fine > 6);
    }
}
