#pragma once

#include "phasefield/schemes/production/constants.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

/// The weight δ_m = δ (a + b φ²) of what lives on the membrane, a = 1 − b/5 so that ∫δ_m dψ = 1.
struct MembraneWeight {
    double constant = 1, square = 0;  // a, b
    double cut = 1;                   // 1/∫ δ_m δ/(δ + f) dψ
};

/// f of what is cut off in the tails, δ → δ²/(δ + f), as part of max δ: 4 ε from the membrane normals may cross, and
/// forces there make Newton's method fail.
inline constexpr double tail_cut = constant("tail_cut");

/// 1/∫ δ_m δ/(δ + f) dψ, so that the integral over the layer stays one.
double cut_norm(const MembraneWeight& weight);

/// H_m(φ) with dH_m/dψ = δ_m: −½ … ½, and a little beyond within the layer.
template <class Number>
Number membrane_indicator(const Number& phi, const MembraneWeight& w) {
    const Number phi2 = phi * phi;
    return phi * (0.75 * w.constant + phi2 * (0.25 * (w.square - w.constant) - (0.15 * w.square) * phi2));
}

/// ν [pN µs/nm²]. It steps with H_m, so that its step matches the stress that the membrane takes up.
template <class Number>
Number layer_viscosity(const Number& phi, const FluidParameters& fluid, const MembraneWeight& weight,
                       ViscosityMean mean) {
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular;
    const Number outside = 0.5 + membrane_indicator(phi, weight);
    if (mean == ViscosityMean::harmonic) return 1.0 / (1 / nu2 + (1 / nu1 - 1 / nu2) * outside);
    return nu2 + (nu1 - nu2) * outside;
}

/// The shear that the layer adds to that of two fluids meeting in a sharp membrane, as a length in units of √2 ε: with
/// the stress going from one side's to the other's as H_m does, the velocity's jump across the layer and the mean
/// velocity ∫δ_m u are those of the sharp membrane when it is zero. For the arithmetic mean it is the excess fluidity
/// ∫(1/ν − step) over the mean fluidity; for the harmonic one, and for equal viscosities, ∫(H_m² − ¼).
double excess_shear(const MembraneWeight& weight, const FluidParameters& fluid, ViscosityMean mean);

/// The weight without excess shear, as far as the viscosity stays above half the smaller one (or the fluidity above
/// half the smaller fluidity) in the layer: for arithmetic means that holds for ratios up to about 15.
MembraneWeight membrane_weight(const FluidParameters& fluid, ViscosityMean mean);

}  // namespace endoflow::phasefield::production
