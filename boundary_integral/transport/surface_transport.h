#pragma once

// Conservative transport of the molecules along the moving curve. Unknown: the moments m_k = ∫ c φ_k dA of c
// against the axial functions (dA = r g dξ, no 2π). The φ_k sum to one, so Σ_k m_k is the molecules' mass and
// fluxes between the m_k conserve it to round-off whatever the time step:
//     d(m_k)/dt = ∫ φ_k' c r v dξ - M ∫ (r/g) μ' φ_k' dξ
//     v: tangential velocity of the material relative to the mesh (14); M, mu: the transport law's

#include <Eigen/Core>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/transport_law.h"

namespace endoflow::boundary_integral {

/// ∫ φ_i φ_j dA, axial x axial, and ∫ (r/g) φ_i' φ_j' dξ.
[[nodiscard]] Eigen::MatrixXd surface_mass_matrix(const MembraneSpace& space, const std::vector<CurvePoint>& curve);
[[nodiscard]] Eigen::MatrixXd surface_stiffness_matrix(const MembraneSpace& space,
                                                       const std::vector<CurvePoint>& curve);

/// Coefficients of c from its moments.
[[nodiscard]] Eigen::VectorXd concentration_from_moments(const MembraneSpace& space,
                                                         const std::vector<CurvePoint>& curve,
                                                         const Eigen::VectorXd& moments);

/// d(m)/dt by diffusion alone. Under energetic coupling E's gradient by c is what drives it, and its derivatives below
/// need those of second order.
[[nodiscard]] Eigen::VectorXd diffusion_rate(const MembraneSpace& space, const MembraneSamples& samples,
                                             const Eigen::VectorXd& c, const TransportLaw& law,
                                             const EnergyDerivatives& energy);

/// d(m)/dt by advection with `relative_velocity` (values of v at the Gauss points, nm/µs).
[[nodiscard]] Eigen::VectorXd advection_rate(const MembraneSpace& space, const MembraneSamples& samples,
                                             const std::vector<double>& relative_velocity);

/// Derivative of advection_rate by the mesh's tangential velocity (curve_count), which carries the mesh off the
/// material.
[[nodiscard]] Eigen::MatrixXd advection_from_mesh_velocity(const MembraneSpace& space, const MembraneSamples& samples);

/// Derivatives of diffusion_rate + advection_rate (at fixed v) and of c itself.
struct TransportDerivatives {
    Eigen::MatrixXd c_from_moments;   // dc/dm = M^-1
    Eigen::MatrixXd c_from_curve;     // dc/d(curve coefficients) at fixed m, axial x curve_count
    Eigen::MatrixXd rate_from_c;      // d rate/dc at fixed curve
    Eigen::MatrixXd rate_from_curve;  // d rate/d(curve) at fixed c
};
[[nodiscard]] TransportDerivatives transport_derivatives(const MembraneSpace& space, const MembraneSamples& samples,
                                                         const Eigen::VectorXd& c, const TransportLaw& law,
                                                         const EnergyDerivatives& energy,
                                                         const std::vector<double>& relative_velocity);

}  // namespace endoflow::boundary_integral
