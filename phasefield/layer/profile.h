#pragma once

#include <cmath>

namespace endoflow::phasefield {

inline constexpr double inverse_sqrt2 = 0.70710678118654752440;

/// The layer's parts, as bounds of |φ|.
inline constexpr double layer_edge = 0.9;
inline constexpr double layer_middle = 0.5;  // within it lie 69 % of ∫½|∇φ|

/// Equilibrium profile (3) at signed distance d [nm], d > 0 on the extracellular side.
inline double equilibrium_profile(double distance, double epsilon) {
    return std::tanh(distance * inverse_sqrt2 / epsilon);
}

/// A level-set function and its derivatives at one point of the half plane (r, z).
struct LevelSetPoint {
    double value = 0, r = 0, z = 0;  // φ, ∂φ/∂r, ∂φ/∂z
    double rr = 0, rz = 0, zz = 0;   // second derivatives
};

/// div n of n = ∇φ/|∇φ| in the axisymmetric metric [1/nm], floored where |∇φ| vanishes.
inline double normal_divergence(const LevelSetPoint& phi, double r, double floor) {
    const double a2 = phi.r * phi.r + phi.z * phi.z + floor * floor;
    const double a = std::sqrt(a2);
    const double nHn = (phi.r * phi.r * phi.rr + 2 * phi.r * phi.z * phi.rz + phi.z * phi.z * phi.zz) / a2;
    const double hoop = r > 1e-9 ? phi.r / r : phi.rr;
    return (phi.rr + phi.zz + hoop - nHn) / a;
}

/// P:∇u = u_r,r + u_r/r + u_z,z − n·∇u·n from ∂u_r/∂r, the hoop term u_r/r, ∂u_z/∂z and ∂u_r/∂z + ∂u_z/∂r.
template <class Number>
Number surface_divergence(const Number& normal_r, const Number& normal_z, const Number& rr, const Number& hoop,
                          const Number& zz, const Number& shear) {
    return rr + hoop + zz - (normal_r * normal_r * rr + normal_r * normal_z * shear + normal_z * normal_z * zz);
}

}  // namespace endoflow::phasefield
