#pragma once

#include <cmath>

#include "phasefield/layer/profile.h"
#include "shared/model/bending_model.h"

namespace endoflow::phasefield::paper {

/// The diffuse bending energy (D) in its pointwise pieces. Below the convention map only β(c) [pN nm] and C(c) [1/nm]
/// appear:
///     E = ∫ (a/ε) ½ β f² dx,   a = 3/(2√2),   f = ε Δφ − F(φ, c),   F = (φ² − 1)(φ + ε C/√2)/ε.
/// With β = b/2 and C = 2 H₀ this is the paper's (5)-(8). The unknown of the schemes is the bending moment
/// m = β f [pN] instead of f, which makes g the exact variation of the discrete energy.
inline constexpr double energy_prefactor = 1.0606601717798212866;  // a = 3/(2√2)

/// β, C and their derivatives with respect to c at one point.
struct BendingCoefficients {
    double stiffness, stiffness_c;  // β, dβ/dc
    double curvature, curvature_c;  // C, dC/dc
};

/// c outside [0, 1] is a small numerical overshoot: it is clipped here and nowhere else.
inline BendingCoefficients bending_coefficients(const BendingModel& model, double c) {
    const double clipped = clip_concentration(c);
    const auto stiffness = model.stiffness(clipped);
    const auto curvature = model.spontaneous_curvature(clipped);
    return {stiffness.value, stiffness.first, curvature.value, curvature.first};
}

/// (8): F and its derivatives with respect to φ and C. Units: 1/nm for F, F_phi, F_phiphi; F_C has none.
struct WellForce {
    double value, phi, phiphi, curvature;
};

inline WellForce well_force(double phi, double curvature, double epsilon) {
    const double shift = epsilon * curvature * inverse_sqrt2;
    return {(phi * phi - 1) * (phi + shift) / epsilon, (3 * phi * phi - 1 + 2 * phi * shift) / epsilon,
            (6 * phi + 2 * shift) / epsilon, (phi * phi - 1) * inverse_sqrt2};
}

/// Density of the bending energy (D) in terms of the moment m = β f [pN nm / nm³].
inline double energy_density(double moment, double stiffness, double epsilon) {
    return energy_prefactor * moment * moment / (2 * epsilon * stiffness);
}

/// Factor of ∇c in (20), (32):  e = a ( β'(c) f²/(2ε) − (β f/ε) ∂F/∂c )  [pN/nm²] as a function of φ and m = β f.
struct ConcentrationForce {
    double value, moment, phi;  // e, ∂e/∂m, ∂e/∂φ
};

inline ConcentrationForce concentration_force(double phi, double moment, const BendingCoefficients& b, double epsilon) {
    const double scale = energy_prefactor / epsilon, softness = b.stiffness_c / (b.stiffness * b.stiffness);
    const double F_c = (phi * phi - 1) * inverse_sqrt2 * b.curvature_c;
    return {scale * (0.5 * softness * moment * moment - moment * F_c), scale * (softness * moment - F_c),
            -scale * moment * 2 * phi * inverse_sqrt2 * b.curvature_c};
}

}  // namespace endoflow::phasefield::paper
