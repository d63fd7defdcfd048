#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "phasefield/layer/constants.h"
#include "phasefield/layer/membrane_weight.h"
#include "phasefield/layer/profile.h"
#include "shared/numerics/forward.h"

namespace endoflow::phasefield {

// Functions of ψ across the layer: its profile, the membrane's weight δ_Γ and its integral H_Γ, the energy's weight
// δ_E.

inline const double energy_norm = cut_norm();                           // 1/∫ δ²/(δ + f) dψ
inline const double energy_second_moment = energy_norm * cut_moment();  // M₂ = ∫ ψ² δ_E dψ [ε²]

/// What depends on ψ/ε alone, but for the dimension of δ.
template <class Number>
struct LayerProfile {
    Number phi, delta, well;  // φ, δ [1/nm], (1 − φ²)²
};

template <class Number>
LayerProfile<Number> layer_profile(const Number& psi, double epsilon) {
    const double t = std::tanh(value_of(psi) * inverse_sqrt2 / epsilon);
    const Number phi = chain(psi, t, (1 - t * t) * inverse_sqrt2 / epsilon);
    const Number slope = 1.0 - phi * phi, well = slope * slope;
    return {phi, (0.75 * inverse_sqrt2 / epsilon) * well, well};
}

/// δ [1/nm] with its tails cut off: four ε from the membrane the diffusion along the normals, weighted by δ, shall
/// decide alone, for there normals may cross, and a step multiplies δ by up to exp(2√2 motion/ε).
template <class Number>
Number cut_delta(const LayerProfile<Number>& layer) {
    return layer.delta * kept_by_cut(layer.well, weight_cut);
}

/// δ_Γ [1/nm] with its tails cut off.
template <class Number>
Number delta_Gamma(const LayerProfile<Number>& layer, const MembraneWeight& w) {
    return cut_delta(layer) * weight_factor(layer.phi * layer.phi, w);
}

inline const MembraneWeight normal_weight = weight_of_normals();

/// δ_N [1/nm], with its tails cut off too.
template <class Number>
Number delta_N(const LayerProfile<Number>& layer) {
    return delta_Gamma(layer, normal_weight);
}

/// H_Γ = ∫ δ_Γ dψ from φ = 0, with the tails cut off: what is cut off is ¾ f (A x − B x² + w₄ x³)/(x² + f) dφ with
/// x = 1 − φ², A = w₀ + w₂ + w₄, B = w₂ + 2w₄ and f = weight_cut, in which ∫ x dφ/(x² + f) and √f ∫ dφ/(x² + f) are
/// real and imaginary part of ∫ dφ/(x − i√f).
inline double H_Gamma(double phi, const MembraneWeight& w) {
    static const double root = std::sqrt(weight_cut);
    static const std::complex<double> inverse = 1.0 / std::sqrt(std::complex<double>(1, -root));
    const double x = std::abs(phi) * inverse.real(), y = std::abs(phi) * inverse.imag(), square = y * y;
    const std::complex<double> artanh(0.25 * std::log1p(4 * x / ((1 - x) * (1 - x) + square)),
                                      0.5 * std::atan2(2 * y, (1 - x) * (1 + x) - square));
    const std::complex<double> part = std::copysign(1.0, phi) * artanh * inverse;
    const double first = w.constant + w.square + w.fourth, second = w.square + 2 * w.fourth;
    const double cut = (first - w.fourth * weight_cut) * part.real() - second * (phi - root * part.imag()) +
                       w.fourth * (phi - phi * phi * phi / 3);
    return membrane_indicator(phi, w) - 0.75 * weight_cut * cut;
}

/// δ_E, the weight of the energy: δ with its tails cut off, δ²/(δ + f), so that the defects of ψ where normals cross
/// exert no force, made to integrate to one again. A function of ψ/ε over ε.
template <class Number>
struct EnergyWeight {
    Number value, slope, widening;  // δ_E [1/nm], ∂δ_E/∂ψ, ∂δ_E/∂ε [1/nm²]
};

/// Distance in ε beyond which δ_E, 256 exp(−4√2 ψ/ε)/tail_cut of its largest value, is below round-off of that.
inline const double energy_reach = std::log(256 / (tail_cut * 1e-16)) * inverse_sqrt2 / 4;

/// ε δ_E and ε² ∂δ_E/∂ψ as functions of ψ/ε, with two derivatives each, where φ has this value.
struct ScaledEnergyWeight {
    explicit ScaledEnergyWeight(double phi_here) {
        constexpr double largest = 0.75 * inverse_sqrt2, f = tail_cut * largest;
        const double root = 1 - phi_here * phi_here;
        const Jet<1> phi = chain(Jet<1>::variable(0, 0), phi_here, inverse_sqrt2 * root, -phi_here * root);
        const Jet<1> delta = largest * (1.0 - phi * phi) * (1.0 - phi * phi);
        const Jet<1> inverse = 1.0 / (delta + f), kept = delta * inverse, rest = f * inverse;
        weight = energy_norm * delta * kept;
        slope = (-2 / inverse_sqrt2 * energy_norm) * kept * (kept + 2.0 * rest) * phi * delta;
    }
    Jet<1> weight, slope;
};

/// ε a number or one of the variables.
template <class Number, class Thickness>
EnergyWeight<Number> energy_weight(const Number& psi, const Thickness& epsilon, const ScaledEnergyWeight& scaled) {
    const Thickness inverse = 1.0 / epsilon;
    const std::array<Number, 1> x{psi * inverse};
    const Number value = compose(scaled.weight, x) * inverse;
    const Number slope = compose(scaled.slope, x) * (inverse * inverse);
    return {value, slope, -1.0 * (value + psi * slope) * inverse};
}
template <class Number>
EnergyWeight<Number> energy_weight(const Number& psi, double epsilon) {
    return energy_weight(psi, epsilon, ScaledEnergyWeight(value_of(layer_profile(psi, epsilon).phi)));
}

}  // namespace endoflow::phasefield
