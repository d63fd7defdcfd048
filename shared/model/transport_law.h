#pragma once

#include "shared/model/bending_model.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// Transport of the molecules along the membrane, ∂_t c + c ∇_Γ·u = −∇_Γ·J (14) with the flux
///     J = −M ∇_Γ μ,   μ = p(c) − k Δ_Γ c.
/// Engines know M, k and p alone; what law they come from is said in transport_law(). Under energetic coupling the
/// membrane's energy gives μ, σ̂ (p − k Δ_Γ c) without bending, and k is zero only where nothing diffuses.
struct TransportLaw {
    double mobility;                                            // M; 0: the molecules stay in the material
    double edge_width;                                          // k, nm; 0: diffusion of second order
    ValueAndDerivatives (*local_part)(double c, double width);  // p, p', p''
    bool energetic = false;  // μ = δ(E + E_c)/δc in pN/nm instead of p − k Δ_Γ c, M in nm³/(pN µs)

    [[nodiscard]] ValueAndDerivatives potential(double c) const { return local_part(c, edge_width); }
};

[[nodiscard]] TransportLaw transport_law(const MoleculeParameters& molecules);

}  // namespace endoflow
