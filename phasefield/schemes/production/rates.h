#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

/// The scheme's own rates, diffusivities and compliances in nm, µs and pN: the numbers of [phase_field.production] and
/// of constants.h, which have no unit, times the scales of the problem. So a problem in other units, or with all
/// viscosities larger and all times longer by one factor, has the same solution.
struct SchemeRates {
    double profile_relaxation = 0;        // M_p at most [nm/µs]
    double strain_relaxation = 0;         // ζ [1/µs]
    double crowding = 0;                  // max |c ∂e/∂c| of the flat membrane over ν₁ + ν₂ [nm/µs]
    double stretching_alignment = 0;      // of s [nm²/µs]
    double least_normal_diffusivity = 0;  // of c, times ε³ [nm⁵/µs]
    double fast_membrane = 0;             // from where on its shear asks for all of that [nm/µs]
    double molecule_leak = 0;             // of c [nm/µs]
    double tension_alignment = 0;         // of λ [nm²/(pN µs)]
    double tension_leak = 0;              // of λ and p_Γ [nm²/(pN µs)]
    double layer_pressure_alignment = 0;  // of p_Γ [nm²/(pN µs)]
    double pressure_leak = 0;             // ∇·u per p_Γ [nm/(pN µs)]
    double divergence_penalty = 0;        // of ∇·u over ν, times the membrane's speed [nm/µs]
};

/// Scales: L, length_of_structure(), the membrane's speed V = L/structure_time(), the smaller viscosity ν, and ε.
[[nodiscard]] SchemeRates scheme_rates(const Parameters& parameters);

}  // namespace endoflow::phasefield::production
