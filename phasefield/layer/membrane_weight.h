#pragma once

#include "phasefield/layer/constants.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// The weight δ_Γ = δ (w₀ + w₂ φ² + w₄ φ⁴) of what lives on the membrane, w₀ = 1 − w₂/5 − 3w₄/35: ∫δ_Γ dψ = 1.
struct MembraneWeight {
    double constant = 1, square = 0, fourth = 0;  // w₀, w₂, w₄
    double cut = 1;                               // cut_norm of it
};

/// f of what is cut off in the tails, δ → δ²/(δ + f), as part of max δ: 4 ε from the membrane normals may cross, and
/// forces there make Newton's method fail.
inline constexpr double tail_cut = constant("tail_cut");

/// The same for δ_Γ, as part of its largest value: beyond, alignment along the normals decides alone.
inline constexpr double weight_cut = constant("weight_cut");

/// 1/∫ δ²/(δ + f) dψ, so that the energy's weight integrates to one.
double cut_norm();

/// 1/∫ δ_Γ δ/(δ + f) dψ with δ_Γ as it is, its own tails cut off: the force on molecules has this weight, and the force
/// on the membrane that it cancels with in the net force the energy's. Off by 4e-4, the difference is 0.3 pN.
double cut_norm(const MembraneWeight& weight);

/// ∫ ψ² δ²/(δ + f) dψ [ε²].
double cut_moment();

/// What a cut at f keeps of a weight where (1 − φ²)² is `well`.
template <class Number>
Number kept_by_cut(const Number& well, double f) {
    return well / (well + f);
}

/// δ_Γ/δ at φ².
template <class Number>
Number weight_factor(const Number& phi2, const MembraneWeight& w) {
    return w.constant + phi2 * (w.square + phi2 * w.fourth);
}

/// H_Γ(φ) with dH_Γ/dψ = δ_Γ: −½ … ½, and a little beyond within the layer.
template <class Number>
Number membrane_indicator(const Number& phi, const MembraneWeight& w) {
    const Number phi2 = phi * phi;
    return phi * (0.75 * w.constant + phi2 * (0.25 * (w.square - w.constant) +
                                              phi2 * (0.15 * (w.fourth - w.square) - (0.75 / 7 * w.fourth) * phi2)));
}

/// ν [pN µs/nm²]. It steps with H_Γ, so that its step matches the stress that the membrane takes up.
template <class Number>
Number layer_viscosity(const Number& phi, const FluidParameters& fluid, const MembraneWeight& weight,
                       ViscosityMean mean) {
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular;
    const Number outside = 0.5 + membrane_indicator(phi, weight);
    if (mean == ViscosityMean::harmonic) return 1.0 / (1 / nu2 + (1 / nu1 - 1 / nu2) * outside);
    return nu2 + (nu1 - nu2) * outside;
}

/// The shear that the layer adds to that of two fluids meeting in a sharp membrane. With the stress going from one
/// side's to the other's as H_Γ does, the velocity's jump across the layer and the mean velocity ∫δ_Γ u are those of
/// the sharp membrane when `sum`, of first order in ε, is zero, and the flow through a pipe of membrane when `moment`,
/// of second order, is.
struct ExcessShear {
    double sum;     // ∫(1/ν − step) dψ over the mean fluidity [√2 ε]
    double moment;  // ∫ψ (1/ν − step) dψ over the mean fluidity [2 ε²]
};

/// For equal viscosities and for the harmonic mean, where ∫(1/ν − step) vanishes whatever the weight, the integrals
/// are ∫(2 H_Γ² − ½) and ∫2 ψ (H_Γ − ½ sign ψ), to which they tend over powers of the contrast.
ExcessShear excess_shear(const MembraneWeight& weight, const FluidParameters& fluid, ViscosityMean mean);

/// The weight without excess shear. With arithmetic means both integrals vanish for ratios of the viscosities up to
/// `largest_ratio`; beyond, the weight for that ratio is mixed with δ until the viscosity stays above the part
/// `smallest_viscosity` of the smaller one. With harmonic means w₄ = 0 and only the sum vanishes, as far as the
/// fluidity stays above half the smaller one.
MembraneWeight membrane_weight(const FluidParameters& fluid, ViscosityMean mean);

/// δ_N, for which ∫ ψ² δ_N dψ = ∫ |ψ|³ δ_N dψ = 0. Under a normal force on a membrane that cannot stretch, fluid at the
/// distance ψ moves at (1 + k|ψ|) exp(−k|ψ|) = 1 − (kψ)²/2 + |kψ|³/3 − … of the membrane's speed, k the wave number: a
/// force and a mean velocity with this weight are those of a sharp membrane up to (kε)⁴, whatever the viscosities.
MembraneWeight weight_of_normals();

}  // namespace endoflow::phasefield
