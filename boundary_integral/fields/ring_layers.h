#pragma once

// Velocity and pressure of layers of rings at one point off the surfaces. With x = source - target, Phi = grad(1/ρ),
// visc = ν₁ - ν₂ and n on the membrane, ν_k and the outward normal on a wall of phase k:
//     8 π ν u(x0) = ∫ f.G dA - visc ∫ u.T.n dA
//     4 π p(x0)    = ∫ f.Phi dA - 2 visc ∫ u_j n_k d_j d_k (1/ρ) dA
// Second derivatives of 1/rho are too singular to be integrated near the surface. As 1/rho is harmonic, n_k d_j Phi_k =
// (n_k d_j - n_j d_k) Phi_k, which are derivatives along the surface; integrated by parts (the boundary terms of
// membrane and walls cancel at the rim, where u is continuous and ν₁ - (ν₁ - ν₂) - ν₂ = 0):
//     4 π p(x0)    = ∫ q.Phi dA,      q = f + 2 visc [ n ∇_Γ·u - (du/ds.n) t ]
// The jump of p across the membrane is q.n = f.n + 2 (ν₁ - ν₂) ∇_Γ·u, as (A.17) wants.

#include <span>
#include <vector>

#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/operators/layer_target.h"

namespace endoflow::boundary_integral {

/// Densities at one quadrature point times its measure r ds (no 2π).
struct RingDensity {
    double force_r, force_z;        // f [pN]
    double momentum_r, momentum_z;  // visc u [pN nm]
    double pressure_r, pressure_z;  // q [pN]
};

struct RingPoint {
    double r, z, normal_r, normal_z;
};

struct ChargedRing {
    RingPoint point;
    RingDensity density;
};

/// The quadrature points of all surfaces as one target sees them. Serves one target after the other without allocating
/// anew; one object for each thread.
class RingLayers {
  public:
    void start(const Target& target);
    void add(std::span<const ChargedRing> rings);

    struct Sum {
        double momentum_r, momentum_z;  // 8 π ν u [pN/nm]
        double pressure;                // p [pN/nm²]
    };
    [[nodiscard]] Sum evaluate();

  private:
    Target target_;
    std::size_t count_ = 0;  // of the rings in use; the vectors only grow
    RingSources sources_;
    RingDensities densities_;
    RingContributions contributions_;
};

}  // namespace endoflow::boundary_integral
