#pragma once

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

/// Beside the coat's edge c leaves [0, 1] by some hundredths. That is harmless as long as b(c) stays positive; bending
/// with a negative stiffness is ill-posed, and no time step would be small enough: SolverError("negative-stiffness").
void check_stiffness(const Evaluation& evaluation, const MembraneDynamics& dynamics, const Parameters& parameters,
                     double time);

}  // namespace endoflow::boundary_integral
