#pragma once

// The fields of a run: velocity, pressure and phase on a grid of squares over the box.

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "shared/output/vtu_file.h"

namespace endoflow::boundary_integral {

// The flow must have been solved in the box. Point data "velocity" [nm/us], "pressure" [pN/nm^2], and "phi": 1
// extracellular, -1 intracellular. `spacing` in nm.
QuadGrid field_grid(const Parameters& parameters, const MembraneDynamics& dynamics, const Evaluation& evaluation,
                    double spacing);

}  // namespace endoflow::boundary_integral
