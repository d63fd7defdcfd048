#pragma once

// The energy of the discrete membrane with exact first and second derivatives, and the surface divergence.
// All integrals leave out the common factor 2π of the azimuth: E here is (energy)/(2π), dA = r g dξ.

#include <Eigen/Core>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::boundary_integral {

struct EnergyDerivatives {
    double energy = 0.0;         // E/(2π) [pN nm]
    Eigen::VectorXd gradient;    // dE/d(r, z coefficients) [pN], curve_count, at fixed c(ξ)
    Eigen::VectorXd gradient_c;  // dE/d(c coefficients), axial_count
    Eigen::MatrixXd hessian;     // curve_count x curve_count, with that of the constraints if multipliers are given
    Eigen::MatrixXd mixed;       // d gradient / d c, curve_count x axial_count
    Eigen::MatrixXd second_c;    // d gradient_c / d c, axial_count x axial_count
};

enum class Derivatives { first, second };

/// What holds the membrane together beside its elasticity.
struct Multipliers {
    Eigen::VectorXd tension;  // coefficients of λ, pN/nm; zero without inextensibility
    double pressure = 0.0;    // of a closed membrane's volume, inside less outside with the sign of a load, pN/nm²
};

/// E = ∫ e(κ, c, |∇_Γ c|²) dA. With second derivatives, multipliers add the Hessian of
/// ∫ λ dA + pressure V at fixed λ(ξ).
[[nodiscard]] EnergyDerivatives energy_derivatives(const MembraneSpace& space, const MembraneState& state,
                                                   const MembraneEnergy& energy, Derivatives wanted,
                                                   const Multipliers& multipliers = {});

/// Energy per area e at the rim [pN/nm]: what inflowing membrane brings with it.
[[nodiscard]] double energy_density_at_rim(const MembraneSpace& space, const MembraneState& state,
                                           const MembraneEnergy& energy);

/// Weak surface divergence: (C u)_k = ∫ μ_k ∇_Γ·u dA = ∫ μ_k D(r g)[u] dξ; tension x curve_count. Its
/// transpose times λ is the gradient of ∫ λ dA.
[[nodiscard]] Eigen::MatrixXd divergence_matrix(const MembraneSpace& space, const MembraneSamples& samples);

/// d(C u)/d(coefficients) at fixed u; tension x curve_count.
[[nodiscard]] Eigen::MatrixXd divergence_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                                   const Eigen::VectorXd& velocity);

/// The volume V/(2π) = −½ ∫ r² z' dξ inside a closed membrane: its gradient ∫ w.n dA, curve_count, and the
/// gradient's variation times a velocity.
[[nodiscard]] Eigen::RowVectorXd volume_gradient(const MembraneSpace& space, const MembraneSamples& samples);
[[nodiscard]] Eigen::RowVectorXd volume_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                                  const Eigen::VectorXd& velocity);

/// N(i, j) = ∫ w_i . f_j dA between velocities (curve_count) and force densities (force_count).
[[nodiscard]] Eigen::MatrixXd force_mass_matrix(const MembraneSpace& space, const MembraneSamples& samples);

/// Values of a tension-space or axial-space function at the Gauss points.
[[nodiscard]] std::vector<double> values_at_points(const std::vector<BasisRow>& rows,
                                                   const Eigen::VectorXd& coefficients);

}  // namespace endoflow::boundary_integral
