#pragma once

#include "statics/piecewise_solution.h"
#include "statics/shape_equations.h"

namespace endoflow::statics {

/// Integrals over a stationary membrane. With G = E + E_c + σ A − p V − F z̄ they are its derivatives along branches:
/// dG/dσ = A, dG/dp = −V, dG/dF = −z̄; where coupled molecules move, with − μ c(rim) dA more, for none come with the
/// membrane that flows in.
struct ShapeIntegrals {
    double energy;     // E + E_c, pN nm
    double area;       // A, nm²
    double volume;     // V above the rim's height, nm³
    double extension;  // z̄ over the rim's height, nm: where the pole force acts
    double edge;       // E_c alone, pN nm

    [[nodiscard]] double potential(const Loads& loads) const {
        return energy + loads.rim_tension * area - loads.pressure * volume - loads.pole_force * extension;
    }
};

[[nodiscard]] ShapeIntegrals shape_integrals(const StationaryCase& stationary, const PiecewiseSolution& solution,
                                             const GaussRule& rule);

}  // namespace endoflow::statics
