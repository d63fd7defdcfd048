#pragma once

// The axisymmetric state that is perturbed: shape, concentration, and the flow that goes with them, with all that the
// perturbed conditions on the membrane need of it.

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/flow/flow_model.h"
#include "boundary_integral/membrane/membrane_space.h"
#include "boundary_integral/modes/surface_variation.h"

namespace endoflow::boundary_integral {

/// Coefficients in the axisymmetric spaces; see FlowSolution.
struct BaseState {
    MembraneState membrane;
    Eigen::VectorXd velocity;      // curve_count, nm/us
    Eigen::VectorXd force;         // force_count, pN/nm^2
    Multipliers multipliers;       // tension, pressure
    double inflow = 0.0;           // nm/us
    Eigen::VectorXd walls;         // unknowns of WallPanels; empty in free space
    Eigen::VectorXd traction_sum;  // force_count: (sigma_1 + sigma_2).n at the membrane, up to a pressure
};

/// Flow, tension and walls as the axisymmetric engine has them; without traction_sum.
[[nodiscard]] BaseState base_state(const MembraneDynamics& dynamics, const Evaluation& evaluation);

struct Viscosities {
    double below, above;  // fluids 1 and 2, pN us/nm^2
    [[nodiscard]] double sum() const { return below + above; }
    [[nodiscard]] double contrast() const { return below - above; }
};

/// Tangential and normal component in the meridian plane.
struct TangentNormal {
    double tangential, normal;
};

/// The base state at one point of the membrane. t, n: tangent towards the rim, normal into the cell; s: arc length.
struct BasePoint {
    CurvePoint curve;
    Derivatives2 normal_r, normal_z;  // with derivatives in xi
    double c, c_s;                    // 1, 1/nm
    double tension;                   // pN/nm
    Derivatives2 u_r, u_z;            // velocity with derivatives in xi
    double u_t, u_n;                  // nm/us
    double stretch_s, stretch_phi;    // t.d_s u and u_r/r, 1/us
    double turning;                   // n.d_s u, 1/us
    double f_t, f_n;                  // pN/nm^2
    double stress_s, stress_phi;      // jump of the stress tt and phi phi across the membrane, pN/nm^2
    TangentNormal slope_jump;         // nu_1 d_n u_1 - nu_2 d_n u_2
    TangentNormal slope_sum;          // nu_1 d_n u_1 + nu_2 d_n u_2

    [[nodiscard]] double tangent_r() const { return curve.r1 / curve.g; }
    [[nodiscard]] double tangent_z() const { return curve.z1 / curve.g; }
};

/// At xi, the polynomial piece of `element` (-1: find it).
///
/// What the flow's equations say of the jumps, with div_Gamma u = stretch_s + stretch_phi:
///   (sigma_1 - sigma_2).n = f,   n.d_n u = -div_Gamma u   on both sides
///   [sigma_tt] = f_n + 2 [nu] (div_Gamma u + t.d_s u),   likewise phi phi
///   nu_k t.d_n u_k = t.sigma_k.n - nu_k n.d_s u
[[nodiscard]] BasePoint base_point(const MembraneSpace& space, const BaseState& base, const Viscosities& viscosities,
                                   double xi, Index element = -1);

}  // namespace endoflow::boundary_integral
