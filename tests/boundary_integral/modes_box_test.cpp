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

// At r, of a packet whose ripples of wave number k are multiplied by symbol(k).
double multiplied(const Profile& symbol, double q, int mode, double r) {
    const double square = envelope * envelope;
    double sum = 0;
    constexpr int count = 2000;
    const double step = (q + 12 / envelope) / count;
    for (int i = 0; i < count; ++i) {  // midpoint rule, spectrally accurate for this integrand
        const double k = (i + 0.5) * step, argument = q * k * square;
        sum += step * k * square * std::exp(-0.5 * (q - k) * (q - k) * square - argument) *
               std::cyl_bessel_i(mode, argument) * symbol(k) * std::cyl_bessel_j(mode, k * r);
    }
    return sum;
}

// The flat membrane without molecules, under the case's tension.
BaseState flat(const Parameters& parameters, const MembraneSpace& space) {
    BaseState base =
        at_rest(space, state_of(
                           space, [&](double x) { return parameters.domain.radius * x; },
                           [&](double) { return parameters.domain.membrane_height; }, [](double) { return 0.0; }));
    base.multipliers.tension.setConstant(parameters.membrane.rim_tension);
    return base;
}

// dw/dt and dc'/dt of ripples w and c' with wave number k.
struct FlatRates {
    Profile w_by_w, w_by_c, c_by_w, c_by_c;
};

// e = 1/2 beta (k^2 w - C1 c')^2 + ..., C1 = dC/dc: ripples move with the normal force f = -k^2 beta (k^2 w - C1 c') -
// sigma k^2 w at f/(2 (nu1 + nu2) k). W''(0) = 2.
FlatRates flat_rates(const Parameters& p) {
    const BendingModel model(p.membrane);
    const double beta = model.stiffness(0).value, slope = model.spontaneous_curvature(0).first;
    const double friction = 2 * (p.fluid.viscosity_extracellular + p.fluid.viscosity_intracellular);
    const double mobility = p.molecules.mobility, width = p.molecules.interface_width, line = p.molecules.line_energy;
    const bool coupled = p.molecules.coupling == Coupling::energetic;
    const double growth = p.molecules.exchange == Exchange::edge ? std::sqrt(2) * p.molecules.edge_speed / width : 0;
    return {[=, tension = p.membrane.rim_tension](double k) { return -(beta * k * k * k + tension * k) / friction; },
            [=](double k) { return beta * slope * k / friction; },
            [=](double k) { return coupled ? mobility * beta * slope * std::pow(k, 4) : 0.0; },
            [=](double k) {
                const double edge = width * k * k + 2 / width;
                return growth - mobility * k * k * (coupled ? beta * slope * slope + line * edge : edge);
            }};
}

// Of the rates of w and c' of one packet, relative to their largest values; the packet is one of `w` and `c`.
struct RateErrors {
    double w, c;
};
RateErrors largest_error(const Parameters& parameters, const LinearisedMembrane& membrane, const ModeSpace& space,
                         double q, double w, double c) {
    const SplineSpace& splines = space.vertical();
    const double rim = parameters.domain.radius;
    const Eigen::VectorXd values = spline_of(splines, [&](double x) { return packet(q, space.mode(), rim * x); });
    // Its coefficients in the mode's space, which holds it but for the approximation near the axis.
    const auto fitted = [&](const Eigen::MatrixXd& expansion) -> Eigen::VectorXd {
        return (expansion.transpose() * expansion).ldlt().solve(expansion.transpose() * values);
    };
    const Eigen::MatrixXd displaced = space.displacement_expansion(), scalar = space.scalar().expansion();
    const ModeRates rates = membrane.rates(space.mode());
    Eigen::VectorXd y(rates.material.cols());
    y << w * fitted(displaced), c * fitted(scalar);
    const Eigen::VectorXd rate = rates.material * y;
    const FlatRates expected = flat_rates(parameters);
    const auto error = [&](const Eigen::VectorXd& computed, const Profile& by_w, const Profile& by_c) {
        double largest = 0, scale = 0;
        for (int i = 0; i < 60; ++i) {
            const double x = i / 100.0;
            const double exact =
                multiplied([&](double k) { return w * by_w(k) + c * by_c(k); }, q, space.mode(), rim * x);
            largest = std::max(largest, std::abs(splines.basis(x).evaluate(computed) - exact));
            scale = std::max(scale, std::abs(exact));
        }
        return scale > 0 ? largest / scale : largest;
    };
    return {error(displaced * rate.head(rates.displacements), expected.w_by_w, expected.w_by_c),
            error(scalar * rate.tail(scalar.cols()), expected.c_by_w, expected.c_by_c)};
}

std::vector<RateErrors> largest_errors(const Parameters& parameters, double q, const std::vector<int>& modes,
                                       Index elements, double w = 1, double c = 0) {
    const MembraneSpace space(elements, 8);
    const Surroundings surroundings(parameters, space, modes.back());
    const LinearisedMembrane membrane(parameters, surroundings, flat(parameters, space));
    std::vector<RateErrors> errors;
    for (const int mode : modes) {
        errors.push_back(largest_error(parameters, membrane, surroundings.space(mode), q, w, c));
    }
    return errors;
}

}  // namespace

TEST_CASE("ripples J_m(q r) cos(m phi) of the flat membrane relax at beta q^3 / (2 (nu1 + nu2))", "[modes]") {
    const Parameters parameters;
    const std::vector<int> modes = {0, 1, 2, 3, 5, 8};
    const std::vector<RateErrors> coarse = largest_errors(parameters, 0.6, modes, 48);
    const std::vector<RateErrors> fine = largest_errors(parameters, 0.6, modes, 96);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        CAPTURE(modes[i], coarse[i].w, fine[i].w);
        // As for m = 0 a fourth derivative of quintic splines; near the axis J_5 is what they know least of.
        CHECK(fine[i].w < 3e-4);
        CHECK(std::log2(coarse[i].w / fine[i].w) > 3);
    }
}

TEST_CASE("ripples of a flat membrane under tension, of molecules that energy drives and that grow", "[modes]") {
    Parameters parameters;
    parameters.membrane.rim_tension = 20;  // as much as bending at the packet's wave number, and a half more
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 60;
    parameters.molecules.mobility = 2000;
    parameters.molecules.interface_width = 3;
    parameters.molecules.exchange = Exchange::edge;
    parameters.molecules.edge_speed = 1e5;
    const auto [w, c] = GENERATE(std::pair(1.0, 0.0), std::pair(0.0, 1.0));
    const std::vector<int> modes = {0, 1, 2, 5};
    const std::vector<RateErrors> coarse = largest_errors(parameters, 0.6, modes, 48, w, c);
    const std::vector<RateErrors> fine = largest_errors(parameters, 0.6, modes, 96, w, c);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        CAPTURE(w, modes[i], coarse[i].w, fine[i].w, coarse[i].c, fine[i].c);
        CHECK(fine[i].w < 3e-4);
        CHECK(std::log2(coarse[i].w / fine[i].w) > 3);
        // c' has a fourth derivative of quintic splines, too, and no fluid that smooths it by one: order 2.
        CHECK(fine[i].c < 2e-3);
        CHECK(std::log2(coarse[i].c / fine[i].c) > 2);
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
