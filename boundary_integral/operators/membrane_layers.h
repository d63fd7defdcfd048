#pragma once

// Single and double layer of the membrane as matrices that map spline coefficients to values at targets:
//     single(x0) = ∫_Gamma f.G dS,    doubled(x0) = PV ∫_Gamma u.T.n dS.

#include <vector>

#include "boundary_integral/operators/membrane_surface.h"

namespace endoflow::boundary_integral {

struct MembraneLayers {
    RowMatrix single;   // rows x force_count
    RowMatrix doubled;  // rows x curve_count
};

[[nodiscard]] MembraneLayers membrane_layers(const MembraneSpace& space, const MembraneState& state,
                                             const MembraneSamples& samples, const std::vector<LayerTarget>& targets,
                                             Index rows, const LayerQuadrature& quadrature);

}  // namespace endoflow::boundary_integral
