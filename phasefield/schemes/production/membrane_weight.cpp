#include "phasefield/schemes/production/membrane_weight.h"

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace endoflow::phasefield::production {

namespace {

constexpr double smallest_square = constant("smallest_square");
constexpr double monotonic_square = constant("monotonic_square");
constexpr double equal_viscosities = constant("equal_viscosities");
constexpr double smallest_viscosity = constant("smallest_viscosity");
constexpr double nearly_one = 1 - 1e-9;  // the integrands tend to 0 there, as 0/0

MembraneWeight weight_of(double square) {
    return {1 - square / 5, square};
}

/// max H_m − ½.
double overshoot(double square) {
    if (square >= monotonic_square) return 0;
    const MembraneWeight w = weight_of(square);
    return membrane_indicator(std::sqrt(-w.constant / w.square), w) - 0.5;
}

/// The zero of f in [a, b]; where f has one sign, the end nearer to zero.
template <class Function>
double zero_of(const Function& f, double a, double b) {
    const double fa = f(a), fb = f(b);
    if (fa * fb >= 0) return std::abs(fa) < std::abs(fb) ? a : b;
    std::uintmax_t iterations = 100;
    const auto bracket =
        boost::math::tools::toms748_solve(f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(40), iterations);
    return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

double cut_norm(const MembraneWeight& weight) {
    const auto integrand = [&](double phi) {  // dH_m/dφ times the part that is kept
        const double well = 1 - phi * phi, kept = well * well / (well * well + tail_cut);
        return 0.75 * well * (weight.constant + weight.square * phi * phi) * kept;
    };
    return 0.5 / boost::math::quadrature::tanh_sinh<double>().integrate(integrand, 0.0, 1.0);
}

double excess_shear(const MembraneWeight& weight, const FluidParameters& fluid, ViscosityMean mean) {
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular, far = 1 / nu1 + 1 / nu2;
    const auto fluidity = [&](double phi) { return 1 / layer_viscosity(phi, fluid, weight, mean); };
    const bool squares = mean == ViscosityMean::harmonic || std::abs(nu1 / nu2 - 1) < equal_viscosities;
    const auto integrand = [&](double phi) {
        const double h = membrane_indicator(phi, weight);
        return (squares ? 2 * h * h - 0.5 : (fluidity(phi) + fluidity(-phi)) / far - 1) / (1 - phi * phi);
    };
    return boost::math::quadrature::tanh_sinh<double>().integrate(integrand, 0.0, nearly_one);
}

MembraneWeight membrane_weight(const FluidParameters& fluid, ViscosityMean mean) {
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular;
    const double contrast = std::max(nu1, nu2) / std::min(nu1, nu2) - 1;
    const auto too_far = [&](double square) { return contrast * overshoot(square) - (1 - smallest_viscosity); };
    const double lowest =
        too_far(smallest_square) > 0 ? zero_of(too_far, smallest_square, monotonic_square) : smallest_square;
    const auto excess = [&](double square) { return excess_shear(weight_of(square), fluid, mean); };
    MembraneWeight weight = weight_of(zero_of(excess, lowest, 0.0));
    weight.cut = cut_norm(weight);
    return weight;
}

}  // namespace endoflow::phasefield::production
