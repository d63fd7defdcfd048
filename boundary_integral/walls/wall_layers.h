#pragma once

// Layers on the walls as matrices that act on the unknowns of WallPanels:
//     Σ_k ν_k ∫_{wall k} u.T.m dS - ∫_band t.G dS.

#include <vector>

#include "boundary_integral/operators/layer_matrices.h"
#include "boundary_integral/walls/wall_surface.h"

namespace endoflow::boundary_integral {

/// Of velocities with 2 components or, for modes, 3: component j of node i is column `components` i + j.
[[nodiscard]] std::vector<LayerColumns> wall_columns(std::size_t components, RowMatrix& matrix);

/// Rows of axisymmetric flow.
[[nodiscard]] RowMatrix wall_layers(const WallPanels& walls, const std::vector<LayerTarget>& targets, Index rows,
                                    int threads = 1);

}  // namespace endoflow::boundary_integral
