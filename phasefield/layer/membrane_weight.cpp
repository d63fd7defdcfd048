#include "phasefield/layer/membrane_weight.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <functional>
#include <utility>

#include "shared/numerics/root.h"

namespace endoflow::phasefield {

namespace {

constexpr double smallest_square = constant("smallest_square");
constexpr double monotonic_square = -1.25;  // δ_Γ = (1 − b/5 + b φ²) δ ≥ 0 from here on
constexpr double equal_viscosities = constant("equal_viscosities");
constexpr double smallest_fluidity = constant("smallest_fluidity");
constexpr double largest_ratio = constant("largest_ratio");
constexpr double ratio_step = constant("ratio_step");
constexpr double smallest_viscosity = constant("smallest_viscosity");
constexpr double nearly_one = 1 - 1e-9;  // φ where the integrands have decayed

MembraneWeight weight_of(double square, double fourth) {
    return {1 - square / 5 - 3 * fourth / 35, square, fourth};
}

/// max H_Γ − ½ of a weight without φ⁴.
double overshoot(double square) {
    if (square >= monotonic_square) return 0;
    const MembraneWeight w = weight_of(square, 0);
    return membrane_indicator(std::sqrt(-w.constant / w.square), w) - 0.5;
}

/// The zero of f in [a, b]; where f has one sign, the end nearer to zero.
template <class Function>
double zero_of(const Function& f, double a, double b) {
    const double fa = f(a), fb = f(b);
    if (fa * fb >= 0) return std::abs(fa) < std::abs(fb) ? a : b;
    return root_between(f, a, b, fa, fb, 40);
}

double ratio_of(const FluidParameters& fluid) {
    const auto [low, high] = std::minmax(fluid.viscosity_extracellular, fluid.viscosity_intracellular);
    return high / low;
}

bool by_squares(const FluidParameters& fluid, ViscosityMean mean) {
    return mean == ViscosityMean::harmonic || ratio_of(fluid) - 1 < equal_viscosities;
}

/// Newton's method for both integrals from a weight that is near.
MembraneWeight without_excess(const FluidParameters& fluid, MembraneWeight weight) {
    constexpr double difference = 1e-5, arrived = 1e-11;
    constexpr int most = 20;
    const auto excess = [&](double square, double fourth) {
        return excess_shear(weight_of(square, fourth), fluid, ViscosityMean::arithmetic);
    };
    for (int iteration = 0; iteration < most; ++iteration) {
        const double b = weight.square, c = weight.fourth;
        const ExcessShear f = excess(b, c);
        const ExcessShear up_b = excess(b + difference, c), down_b = excess(b - difference, c);
        const ExcessShear up_c = excess(b, c + difference), down_c = excess(b, c - difference);
        const double sum_b = up_b.sum - down_b.sum, sum_c = up_c.sum - down_c.sum;
        const double moment_b = up_b.moment - down_b.moment, moment_c = up_c.moment - down_c.moment;
        const double scale = 2 * difference / (sum_b * moment_c - sum_c * moment_b);
        const double step_b = scale * (sum_c * f.moment - moment_c * f.sum);
        const double step_c = scale * (moment_b * f.sum - sum_b * f.moment);
        weight = weight_of(b + step_b, c + step_c);
        if (std::abs(step_b) + std::abs(step_c) < arrived * std::abs(b)) break;
    }
    return weight;
}

/// Of a weight t and δ the rest: the part of the smaller viscosity to which it falls where the larger one is `ratio`
/// times as large.
double lowest_viscosity(const MembraneWeight& weight, double t, double ratio) {
    constexpr int points = 1000;
    double largest = 0.5;  // of H_Γ
    for (int i = 1; i < points; ++i) {
        const double phi = static_cast<double>(i) / points;
        largest = std::max(largest, t * membrane_indicator(phi, weight) + (1 - t) * membrane_indicator(phi, {}));
    }
    return 1 - (ratio - 1) * (largest - 0.5);
}

/// From equal viscosities, where the weight is known, to larger and larger contrasts.
MembraneWeight quartic_weight(const FluidParameters& fluid) {
    const double ratio = std::min(ratio_of(fluid), largest_ratio);
    const bool inverse = fluid.viscosity_extracellular > fluid.viscosity_intracellular;
    MembraneWeight weight = weight_of(constant("equal_square"), constant("equal_fourth"));
    double reached = 1;
    do {
        reached = std::min(ratio, reached * ratio_step);
        FluidParameters between = fluid;
        between.viscosity_extracellular = 1;
        between.viscosity_intracellular = reached;
        if (inverse) std::swap(between.viscosity_extracellular, between.viscosity_intracellular);
        weight = without_excess(between, weight);
    } while (reached < ratio);
    const auto margin = [&](double t) { return lowest_viscosity(weight, t, ratio_of(fluid)) - smallest_viscosity; };
    if (margin(1) >= 0) return weight;
    const double part = zero_of(margin, 0.0, 1.0);
    return weight_of(part * weight.square, part * weight.fourth);
}

MembraneWeight quadratic_weight(const FluidParameters& fluid, ViscosityMean mean) {
    const double contrast = ratio_of(fluid) - 1;
    const auto too_far = [&](double square) { return contrast * overshoot(square) - (1 - smallest_fluidity); };
    const double lowest =
        too_far(smallest_square) > 0 ? zero_of(too_far, smallest_square, monotonic_square) : smallest_square;
    const auto excess = [&](double square) { return excess_shear(weight_of(square, 0), fluid, mean).sum; };
    return weight_of(zero_of(excess, lowest, 0.0), 0);
}

double integral_over_half(const std::function<double(double)>& integrand) {
    return boost::math::quadrature::tanh_sinh<double>().integrate(integrand, 0.0, 1.0);
}

double kept(double phi, double f) {
    return kept_by_cut((1 - phi * phi) * (1 - phi * phi), f);
}

/// dψ δ over dφ, what the energy's weight keeps of it.
double energy_part(double phi) {
    return 0.75 * (1 - phi * phi) * kept(phi, tail_cut);
}

}  // namespace

double cut_moment() {
    return 2 * integral_over_half([](double phi) {  // ψ² = 2 ε² atanh² φ
               const double distance = std::atanh(std::min(phi, nearly_one));
               return 2 * distance * distance * energy_part(phi);
           });
}

double cut_norm() {
    return 0.5 / integral_over_half(energy_part);
}

double cut_norm(const MembraneWeight& weight) {
    return 0.5 / integral_over_half([&](double phi) {
               return energy_part(phi) * weight_factor(phi * phi, weight) * kept(phi, weight_cut);
           });
}

ExcessShear excess_shear(const MembraneWeight& weight, const FluidParameters& fluid, ViscosityMean mean) {
    const double inner = 1 / fluid.viscosity_extracellular, outer = 1 / fluid.viscosity_intracellular;
    const double far = inner + outer;
    const auto fluidity = [&](double phi) { return 1 / layer_viscosity(phi, fluid, weight, mean); };
    const bool squares = by_squares(fluid, mean);
    // dφ/(1 − φ²) = ds: over s, nothing is 0/0 at the layer's outer end.
    const auto sum = [&](double s) {
        const double phi = std::tanh(s), h = membrane_indicator(phi, weight);
        return squares ? 2 * h * h - 0.5 : (fluidity(phi) + fluidity(-phi)) / far - 1;
    };
    const auto moment = [&](double s) {
        const double phi = std::tanh(s);
        return s * (squares ? 2 * membrane_indicator(phi, weight) - 1
                            : (fluidity(phi) - inner - fluidity(-phi) + outer) / far);
    };
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    constexpr unsigned int most_halvings = 4;
    constexpr double tolerance = 1e-12;
    const double outer_end = std::atanh(nearly_one);
    return {Rule::integrate(sum, 0.0, outer_end, most_halvings, tolerance),
            Rule::integrate(moment, 0.0, outer_end, most_halvings, tolerance)};
}

MembraneWeight weight_of_normals() {
    // ∫ |ψ|^m δ_N dψ in units of (√2 ε)^m, linear in w₂ and w₄.
    const auto moment = [](double m, double square, double fourth) {
        const MembraneWeight weight = weight_of(square, fourth);
        return integral_over_half([&](double phi) {
            return std::pow(std::atanh(std::min(phi, nearly_one)), m) * (1 - phi * phi) *
                   weight_factor(phi * phi, weight);
        });
    };
    const auto row = [&](double m) {
        const double none = moment(m, 0, 0);
        return std::array{moment(m, 1, 0) - none, moment(m, 0, 1) - none, -none};
    };
    const auto [a, b, f] = row(2);
    const auto [c, d, g] = row(3);
    const double determinant = a * d - b * c;
    return weight_of((f * d - b * g) / determinant, (a * g - c * f) / determinant);
}

MembraneWeight membrane_weight(const FluidParameters& fluid, ViscosityMean mean) {
    MembraneWeight weight = mean == ViscosityMean::harmonic ? quadratic_weight(fluid, mean) : quartic_weight(fluid);
    weight.cut = cut_norm(weight);
    return weight;
}

}  // namespace endoflow::phasefield
