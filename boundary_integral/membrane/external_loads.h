#pragma once

// The loads on the discrete membrane: what they do on its velocities, over 2π as all integrals here.

#include <Eigen/Core>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/loads.h"

namespace endoflow::boundary_integral {

/// Power per velocity coefficient (curve_count), pN: of the rim tension σ R u_r(rim), so that λ(rim) = σ is
/// the natural condition; of the pressure p ∫ u.n dA, which walls with the normal stress -p around the extracellular
/// fluid amount to, as its pressure is p larger everywhere; of the pole force F ∫ share(a) u_z dA.
[[nodiscard]] Eigen::VectorXd external_load(const MembraneSpace& space, const MembraneSamples& samples,
                                            const Loads& loads);

/// d(pole force's part of the load)/d(curve), curve_count x curve_count: a, the area from the pole, moves with the
/// curve. The rim tension's part is constant, and minus the pressure's is what a pressure among the energy's
/// multipliers adds.
[[nodiscard]] Eigen::MatrixXd pole_force_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                                   const Loads& loads);

}  // namespace endoflow::boundary_integral
