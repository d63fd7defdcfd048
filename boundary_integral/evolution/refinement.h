#pragma once

#include <memory>

#include "boundary_integral/evolution/membrane_dynamics.h"

namespace endoflow::boundary_integral {

/// The membrane of a case on so many elements.
[[nodiscard]] std::unique_ptr<MembraneDynamics> dynamics_with(const Parameters& parameters, Index elements);

/// boundary_integral.elements, or as many as the case's initial state needs for boundary_integral.accuracy.
[[nodiscard]] Index initial_elements(const Parameters& parameters);

/// A third more elements, for a state that `accuracy` asks to be refined, or whose energy's balance is off by more than
/// a fifth of what it may be (`balance_bound`). The same number when there may be no more, or the elements suffice.
[[nodiscard]] Index elements_for(const MembraneSpace& space, const MembraneState& state, double accuracy,
                                 double balance = 0.0, double balance_bound = 1.0);

/// The same membrane on the elements of `to`: the curve and c are interpolated, the molecules' mass is the same to
/// round-off.
[[nodiscard]] Eigen::VectorXd transferred(const MembraneDynamics& from, const Eigen::VectorXd& y,
                                          const MembraneDynamics& to);

}  // namespace endoflow::boundary_integral
