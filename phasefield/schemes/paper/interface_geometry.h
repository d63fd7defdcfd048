#pragma once

#include <algorithm>
#include <cmath>

#include "phasefield/layer/profile.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::paper {

/// The layer seen from one point: a = |∇φ| [1/nm], n along ∇φ (towards the extracellular side; every use is even in n),
/// P = I − n n with P_θθ = 1. Where |∇φ| vanishes n is floored to zero, so P becomes the identity there.
struct LayerGeometry {
    double gradient;            // a
    double normal_r, normal_z;  // n
    double P_rr, P_rz, P_zz;    // P
};

inline LayerGeometry layer_geometry(double phi_r, double phi_z, double epsilon) {
    const double floor = 1e-4 / epsilon;
    const double a = std::hypot(phi_r, phi_z);
    const double scale = 1 / std::hypot(a, floor);
    const double nr = phi_r * scale, nz = phi_z * scale;
    return {a, nr, nz, 1 - nr * nr, -nr * nz, 1 - nz * nz};
}

/// Where and how the profile relaxation acts: n, the weight W = (1 − φ⁴)(1 − exp(−((R − r)/(2ε))²)) and ∇·(n W) [1/nm].
/// W fades in the tails of the layer, where n means nothing, and at r = R, where φ is given and the relaxation could
/// only be balanced by a spurious γ g. (A weight that also vanishes on φ = 0, to rule out any slip, was tried:
/// unstable.)
struct ProfileRelaxation {
    double normal_r, normal_z, weight, weighted_normal_divergence;
};

/// `phi` holds the recovered, continuous gradient and its derivatives.
inline ProfileRelaxation profile_relaxation(const LevelSetPoint& phi, double r, double radius, double epsilon) {
    const LayerGeometry layer = layer_geometry(phi.r, phi.z, epsilon);
    const double x = (radius - r) / (2 * epsilon), wall = 1 - std::exp(-x * x);
    const double wall_r = -x / epsilon * std::exp(-x * x);
    const double p = std::clamp(phi.value, -1.0, 1.0), tail = 1 - p * p * p * p;
    const double along_normal = layer.normal_r * phi.r + layer.normal_z * phi.z;
    const double divergence = normal_divergence(phi, r, 1e-4 / epsilon);
    const double weight = tail * wall;
    const double derivative = -4 * p * p * p * along_normal * wall + tail * layer.normal_r * wall_r;
    return {layer.normal_r, layer.normal_z, weight, weight * divergence + derivative};
}

/// ν(φ) [pN µs/nm²]: ν₁ at φ = +1 (extracellular), ν₂ at φ = −1.
inline double viscosity(double phi, const FluidParameters& fluid, ViscosityMean mean) {
    const double weight = 0.5 * (1 + std::clamp(phi, -1.0, 1.0));
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular;
    if (mean == ViscosityMean::harmonic) return 1 / (weight / nu1 + (1 - weight) / nu2);
    return weight * nu1 + (1 - weight) * nu2;
}

}  // namespace endoflow::phasefield::paper
