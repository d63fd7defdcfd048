#pragma once

#include "statics/piecewise_solution.h"
#include "statics/shape_equations.h"

namespace endoflow::statics {

/// Integrals over a stationary membrane. With G = E + E_c + σ A − p V − F z̄ − F_a (z̄_c − z̄_ring) + F_d r̄ they are
/// its derivatives along branches: dG/dσ = A, dG/dp = −V, dG/dF = −z̄, dG/dF_d = r̄, dG/dF_a = −(z̄_c − z̄_ring) of
/// molecules that stay in the material; where coupled molecules move, with − μ c(rim) dA more, for none come with the
/// membrane that flows in.
struct ShapeIntegrals {
    double energy;          // E + E_c, pN nm
    double area;            // A, nm²
    double volume;          // V above the rim's height, nm³
    double extension;       // z̄ over the rim's height, nm: where the pole force acts
    double edge;            // E_c alone, pN nm
    double coat_extension;  // z̄_c − z̄_ring, nm: the coat's height over the ring's, or over the rim's without a ring
    double collar_radius;  // r̄ where the collar is, nm

    [[nodiscard]] double potential(const Loads& loads) const {
        return energy + loads.rim_tension * area - loads.pressure * volume - loads.pole_force * extension -
               loads.coat_force * coat_extension + loads.collar_force * collar_radius;
    }
};

[[nodiscard]] ShapeIntegrals shape_integrals(const StationaryCase& stationary, const PiecewiseSolution& solution,
                                             const GaussRule& rule);

}  // namespace endoflow::statics
