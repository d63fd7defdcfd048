#pragma once

// The loads on the discrete membrane: what they do on its velocities, over 2π as all integrals here.

#include <Eigen/Core>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/loads.h"

namespace endoflow::boundary_integral {

/// Power per velocity coefficient (curve_count), pN: of the rim tension σ R u_r(rim), so that λ(rim) = σ is
/// the natural condition; of the pressure p ∫ u.n dA, which walls with the normal stress -p around the extracellular
/// fluid amount to, as its pressure is p larger everywhere; of the carried forces ∫ (f_r(a) u_r + (f_z(a) + F_a
/// c/∫c dA) u_z) dA, f(a) being what rides on the material.
[[nodiscard]] Eigen::VectorXd external_load(const MembraneSpace& space, const MembraneSamples& samples,
                                            const Loads& loads);

/// Derivatives of the part of the load that material and molecules carry.
struct CarriedLoadDerivatives {
    Eigen::MatrixXd by_curve;  // at c's coefficients, curve_count x curve_count: a, the area from the pole, moves
    Eigen::MatrixXd by_c;      // by c's coefficients, curve_count x axial_count
};

/// The rim tension's part of the load is constant, and minus the pressure's is what a pressure among the energy's
/// multipliers adds.
[[nodiscard]] CarriedLoadDerivatives carried_load_derivatives(const MembraneSpace& space,
                                                              const MembraneSamples& samples, const Loads& loads);

}  // namespace endoflow::boundary_integral
