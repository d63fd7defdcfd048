#pragma once

// Single and double layer of the membrane as matrices that map spline coefficients to values at targets:
//     single(x0) = ∫_Gamma f.G dS,    doubled(x0) = PV ∫_Gamma u.T.n dS.

#include <vector>

#include "boundary_integral/membrane/membrane_space.h"
#include "boundary_integral/operators/element_basis.h"
#include "boundary_integral/operators/layer_block.h"

namespace endoflow::boundary_integral {

struct MembraneTarget {
    Target at;
    TargetRows rows;
    double xi = -1.0;                  // parameter when the target lies on the membrane, -1 otherwise
    const OwnElements* own = nullptr;  // own_elements of ξ, when they are at hand
};

struct MembraneLayers {
    RowMatrix single;   // rows x force_count
    RowMatrix doubled;  // rows x curve_count
};

struct LayerQuadrature {
    int threads = 1;
    int singular_points = 24;    // per side of the target, its own element (unless the target brings its rule)
    int near_points = 20;        // per side of the closest point, near elements
    double near_distance = 0.7;  // in element lengths; there 8 Gauss points miss 3e-11 of a logarithm
};

[[nodiscard]] MembraneLayers membrane_layers(const MembraneSpace& space, const MembraneState& state,
                                             const MembraneSamples& samples, const std::vector<MembraneTarget>& targets,
                                             Index rows, const LayerQuadrature& quadrature);

}  // namespace endoflow::boundary_integral
