#pragma once

#include "boundary_integral/flow/flow_model.h"

namespace endoflow::boundary_integral {

/// Integrals of a solution over the membrane, without the 2π of the azimuth.
struct MembraneFluxes {
    double force = 0.0, force_modulus = 0.0;       // of f_z and |f_z|, pN
    double volume = 0.0, volume_modulus = 0.0;     // of u.n and |u.n|, nm³/µs
    double area_growth = 0.0, area_modulus = 0.0;  // of ∇_Γ·u and |κ u.n|, nm²/µs
};
[[nodiscard]] MembraneFluxes membrane_fluxes(const MembraneSpace& space, const MembraneSamples& samples,
                                             const FlowSolution& flow);

}  // namespace endoflow::boundary_integral
