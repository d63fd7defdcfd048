#pragma once

// What thermal noise about an axisymmetric membrane is made of, one azimuthal mode at a time: the second variation of
// its energy, the covariance of equilibrium, and the strength of the noise. docs/noise.md has the mathematics.

#include "boundary_integral/modes/covariance_propagation.h"
#include "boundary_integral/modes/linearised_membrane.h"

namespace endoflow::boundary_integral {

/// pN nm/K
inline constexpr double boltzmann_constant = 0.0138065;

/// int_0^{2 pi} cos^2(m phi) dphi: energies and powers of mode m are this times integrals along the meridian.
[[nodiscard]] double azimuthal_weight(int mode);

/// The second variation H of energy, tension and pressure for displacements w n, symmetric: w cos(m phi) has the energy
/// azimuthal_weight(mode)/2 w.H w (pN nm), w being its free coefficients.
[[nodiscard]] Eigen::MatrixXd second_variation(const ModeSpace& space, const BasePoints& base);

/// F (nm) with F F^T = thermal_energy/azimuthal_weight(mode) H^-1, the covariance of w in equilibrium;
/// `thermal_energy` k_B T in pN nm. Throws SolverError("no-thermal-equilibrium") where H is not positive.
[[nodiscard]] Eigen::MatrixXd equilibrium_root(const ModeSpace& space, const BasePoints& base, double thermal_energy);

/// D = 2 thermal_energy/azimuthal_weight(mode) M of d Sigma/dt = L Sigma + Sigma L^T + D, M being the symmetric part of
/// ModeRates::thermal_mobility.
[[nodiscard]] Eigen::MatrixXd noise_strength(int mode, const ModeRates& rates, double thermal_energy);

/// The flat membrane of a case in the box without molecules, on the mesh of `state`, whose r it has.
[[nodiscard]] BaseState flat_bare_membrane(const MembraneSpace& space, const MembraneState& state,
                                           const Parameters& parameters);

}  // namespace endoflow::boundary_integral
