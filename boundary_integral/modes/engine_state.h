#pragma once

// States of the axisymmetric engine as base states of its perturbations.

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/modes/base_state.h"

namespace endoflow::boundary_integral {

/// The engine's state vector from spline coefficients.
[[nodiscard]] Eigen::VectorXd state_vector(const MembraneDynamics& dynamics, const MembraneState& state);

/// Flow, tension and walls as the engine has them; without traction_sum.
[[nodiscard]] BaseState engine_state(const MembraneDynamics& dynamics, const Evaluation& evaluation);

/// Coefficients of dc/dt at fixed xi of the moving mesh.
[[nodiscard]] Eigen::VectorXd concentration_rate(const MembraneDynamics& dynamics, const Evaluation& evaluation);

}  // namespace endoflow::boundary_integral
