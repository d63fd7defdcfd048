#pragma once

#include <cmath>
#include <complex>

#include "phasefield/layer/profile.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/membrane_weight.h"
#include "shared/numerics/forward.h"

namespace endoflow::phasefield::production {

// Functions of ψ across the layer: its profile, the membrane's weight δ_m and its integral, the energy's weight.

inline const double energy_norm = cut_norm();                           // 1/∫ δ²/(δ + f) dψ
inline const double energy_second_moment = energy_norm * cut_moment();  // ∫ ψ² δ_E dψ [ε²]

/// φ, δ, δ' and the rest that only depend on ψ.
template <class Number>
struct LayerProfile {
    Number phi, phi_slope;                    // φ, dφ/dψ [1/nm]
    Number delta, delta_slope, squared_well;  // δ [1/nm], dδ/dψ [1/nm²], (1 − φ²)²
};

template <class Number>
LayerProfile<Number> layer_profile(const Number& psi, double epsilon) {
    const double t = std::tanh(value_of(psi) * inverse_sqrt2 / epsilon);
    const Number phi = chain(psi, t, (1 - t * t) * inverse_sqrt2 / epsilon);
    const Number well = 1.0 - phi * phi, squared = well * well;
    const Number delta = (0.75 * inverse_sqrt2 / epsilon) * squared;
    return {phi, (inverse_sqrt2 / epsilon) * well, delta, (-2 / (inverse_sqrt2 * epsilon)) * phi * delta, squared};
}

/// δ [1/nm] with its tails cut off: four ε from the membrane the alignment along the normals, weighted by δ, shall
/// decide alone, for there normals may cross, and a step multiplies δ by up to exp(2√2 motion/ε).
template <class Number>
Number cut_density(const LayerProfile<Number>& layer) {
    return layer.delta * kept_by_cut(layer.squared_well, weight_cut);
}

/// δ_m [1/nm] with its tails cut off.
template <class Number>
Number membrane_density(const LayerProfile<Number>& layer, const MembraneWeight& w) {
    return cut_density(layer) * weight_factor(layer.phi * layer.phi, w);
}

/// ∫ δ_m dψ from φ = 0, with the tails cut off: what is cut off is ¾ f (A x − B x² + c x³)/(x² + f) dφ with x = 1 − φ²,
/// A = a + b + c, B = b + 2c and f = weight_cut, in which ∫ x dφ/(x² + f) and √f ∫ dφ/(x² + f) are real and imaginary
/// part of ∫ dφ/(x − i√f).
inline double cut_indicator(double phi, const MembraneWeight& w) {
    static const double root = std::sqrt(weight_cut);
    static const std::complex<double> end = std::sqrt(std::complex<double>(1, -root));
    const std::complex<double> part = std::atanh(phi / end) / end;
    const double first = w.constant + w.square + w.fourth, second = w.square + 2 * w.fourth;
    const double cut = (first - w.fourth * weight_cut) * part.real() - second * (phi - root * part.imag()) +
                       w.fourth * (phi - phi * phi * phi / 3);
    return membrane_indicator(phi, w) - 0.75 * weight_cut * cut;
}

/// The weight of the bending energy: δ with its tails cut off, δ²/(δ + f), so that the defects of ψ where normals cross
/// exert no force, made to integrate to one again. And its two derivatives with respect to ψ.
template <class Number>
struct EnergyWeight {
    Number value, first, second;
    Number kept;                    // δ/(δ + f)
    Number thickness, thickness_1;  // ∂/∂ε of the weight and of its derivative: it is a function of ψ/ε over ε
};

template <class Number>
EnergyWeight<Number> energy_weight(const LayerProfile<Number>& layer, const Number& psi, double epsilon) {
    const double a = 2 / (inverse_sqrt2 * epsilon);
    const Number& d = layer.delta;
    const Number d1 = layer.delta_slope, d2 = -a * (layer.phi_slope * d + layer.phi * d1);
    const double f = tail_cut * 0.75 * inverse_sqrt2 / epsilon;
    const Number inverse = 1.0 / (d + f), part = d * inverse, rest = f * inverse;
    const Number g1 = part * (part + 2.0 * rest), g2 = 2.0 * rest * rest * inverse;
    const Number w = energy_norm * d * part, w1 = energy_norm * g1 * d1, w2 = energy_norm * (g2 * d1 * d1 + g1 * d2);
    return {w, w1, w2, part, (-1 / epsilon) * (w + psi * w1), (-1 / epsilon) * (2.0 * w1 + psi * w2)};
}

}  // namespace endoflow::phasefield::production
