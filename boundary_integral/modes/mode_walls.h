#pragma once

// The walls of the box for all azimuthal modes at once; see WallPanels. Unknowns 3 i, 3 i + 1 of node i are the
// amplitudes u_r and u_phi, 3 i + 2 is u_z on free walls and t_z ds/d tau in the pin band.
//
// Nothing holds the fluid in the box against a horizontal translation (m = 1): its walls are free of stress, the band
// holds u_z alone. Stokes' equations then have a solution only for forces without a horizontal resultant, and it is
// known up to a translation. So the band, which is the frame that pins the membrane, is held horizontally in the mean:
// int u_x dS = 0 over it, by a uniform horizontal traction of it. One equation and one unknown more; the frame does no
// work.

#include <vector>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/modes/mode_layers.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

/// 3 nodes, and for mode 1 the horizontal traction of the band (pN/nm^2).
[[nodiscard]] Index mode_wall_unknowns(const WallPanels& walls, int mode);

/// The nodes of the walls.
[[nodiscard]] std::vector<LayerTarget> mode_wall_targets(const WallPanels& walls);

/// Rows of sum_k nu_k int_{wall k} u.T.m dS - int_band t.G dS acting on the wall unknowns, of target i as
/// mode_rows(i) has them; one entry per mode 0 ... highest.
[[nodiscard]] std::vector<RowMatrix> mode_wall_layers(const WallPanels& walls, const std::vector<LayerTarget>& targets,
                                                      int highest_mode, int threads);

/// The equations of the walls themselves, square: factors of the matrices for each mode.
[[nodiscard]] std::vector<LuFactors> mode_wall_factors(const WallPanels& walls, int highest_mode, int threads);

}  // namespace endoflow::boundary_integral
