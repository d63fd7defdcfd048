#pragma once

// The energy of the discrete membrane with exact first and second derivatives, and the surface divergence.
// All integrals leave out the common factor 2 pi of the azimuth: E here is (energy)/(2 pi), dA = r g dxi.

#include <Eigen/Core>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::boundary_integral {

struct EnergyDerivatives {
    double energy = 0.0;         // E/(2 pi) [pN nm]
    Eigen::VectorXd gradient;    // dE/d(r, z coefficients) [pN], curve_count, at fixed c(xi)
    Eigen::VectorXd gradient_c;  // dE/d(c coefficients), axial_count
    Eigen::MatrixXd hessian;     // curve_count x curve_count, with that of the constraints if multipliers are given
    Eigen::MatrixXd mixed;       // d gradient / d c, curve_count x axial_count
    Eigen::MatrixXd second_c;    // d gradient_c / d c, axial_count x axial_count
};

enum class Derivatives { first, second };

// What holds the membrane together beside its elasticity.
struct Multipliers {
    Eigen::VectorXd tension;  // coefficients of lambda, pN/nm; zero without inextensibility
    double pressure = 0.0;    // of a closed membrane's volume, inside less outside with the sign of a load, pN/nm^2
};

// E = int e(kappa, c, |grad c|^2) dA. With second derivatives, multipliers add the Hessian of
// int lambda dA + pressure V at fixed lambda(xi).
EnergyDerivatives energy_derivatives(const MembraneSpace& space, const MembraneState& state,
                                     const MembraneEnergy& energy, Derivatives wanted,
                                     const Multipliers& multipliers = {});

// Energy per area e at the rim [pN/nm]: what inflowing membrane brings with it.
double energy_density_at_rim(const MembraneSpace& space, const MembraneState& state, const MembraneEnergy& energy);

// Weak surface divergence: (C u)_k = int mu_k div_Gamma(u) dA = int mu_k D(r g)[u] dxi; tension x curve_count. Its
// transpose times lambda is the gradient of int lambda dA.
Eigen::MatrixXd divergence_matrix(const MembraneSpace& space, const MembraneSamples& samples);

// d(C u)/d(coefficients) at fixed u; tension x curve_count.
Eigen::MatrixXd divergence_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                     const Eigen::VectorXd& velocity);

// The volume V/(2 pi) = - int 1/2 r^2 z' dxi inside a closed membrane: its gradient int w.n dA, curve_count, and the
// gradient's variation times a velocity.
Eigen::RowVectorXd volume_gradient(const MembraneSpace& space, const MembraneSamples& samples);
Eigen::RowVectorXd volume_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                    const Eigen::VectorXd& velocity);

// N(i, j) = int w_i . f_j dA between velocities (curve_count) and force densities (force_count).
Eigen::MatrixXd force_mass_matrix(const MembraneSpace& space, const MembraneSamples& samples);

// Values of a tension-space or axial-space function at the Gauss points.
std::vector<double> values_at_points(const std::vector<BasisRow>& rows, const Eigen::VectorXd& coefficients);

}  // namespace endoflow::boundary_integral
