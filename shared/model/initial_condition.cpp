#include "shared/model/initial_condition.h"

#include <cmath>
#include <numbers>

namespace endoflow {

namespace {

/// The dilogarithm Li₂(−exp(−u)) to round-off: in w = −ln(1 + exp(−u)), |w| <= ln 2, its series has Bernoulli's numbers
/// as coefficients, B_k w^(k+1)/(k+1)!, and negative u follow from positive ones.
double dilogarithm(double u) {
    if (u < 0) return -std::numbers::pi * std::numbers::pi / 6 - 0.5 * u * u - dilogarithm(-u);
    const double w = -std::log1p(std::exp(-u)), w2 = w * w;
    constexpr double terms[] = {1.0 / 36,
                                -1.0 / 3600,
                                1.0 / 211680,
                                -1.0 / 10886400,
                                1.0 / 526901760,
                                -4.0647616451442255e-11,
                                8.9216910204564526e-13};
    double sum = 0, power = w;
    for (const double term : terms) sum += term * (power *= w2);
    return w - 0.25 * w2 + sum;
}

}  // namespace

double initial_concentration(const MoleculeParameters& molecules, double r) {
    const double distance = r - molecules.patch_radius;
    return 0.5 * (1 - std::tanh(distance / (std::numbers::sqrt2 * molecules.interface_width)));
}

// With δ = ε_c/√2 and u = (r − r_c)/δ the profile is c = 1/(1 + exp u), and −δ r ln(1 + exp(−u)) + δ² Li₂(−exp(−u)) has
// the derivative c r.
double initial_coat_within(const MoleculeParameters& molecules, double r) {
    const double width = molecules.interface_width / std::numbers::sqrt2, edge = molecules.patch_radius;
    const auto antiderivative = [&](double at) {
        const double u = (at - edge) / width;
        const double logarithm = u > 0 ? std::log1p(std::exp(-u)) : -u + std::log1p(std::exp(u));
        return width * (width * dilogarithm(u) - at * logarithm);
    };
    return antiderivative(r) - antiderivative(0);
}

}  // namespace endoflow
