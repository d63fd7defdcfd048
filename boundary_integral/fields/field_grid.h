#pragma once

// The fields of a run: velocity, pressure and phase on a grid of squares over the box.

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "shared/output/vtu_file.h"

namespace endoflow::boundary_integral {

/// `flow`: velocity and force in the box; `wall_unknowns` as WallPanels numbers them. Point data "velocity" [nm/µs],
/// "pressure" [pN/nm²], and "phi": 1 extracellular, -1 intracellular. `spacing` in nm.
[[nodiscard]] QuadGrid field_grid(const Parameters& parameters, const MembraneDynamics& dynamics,
                                  const MembraneState& state, const FlowSolution& flow,
                                  const Eigen::VectorXd& wall_unknowns, double spacing);

}  // namespace endoflow::boundary_integral
