#pragma once

// Azimuthally integrated ("ring") kernels of Stokes flow: the free-space Stokeslet G and stresslet T of a source ring
// seen from one point. With x = source - target, ρ = |x|:
//     G_ij = δ_ij / ρ + x_i x_j / ρ³,        T_ijk = -6 x_i x_j x_k / ρ⁵                       (Pozrikidis
//     1992)
// and the azimuthal integral over the source angle φ in (0, 2π). Only σ = sin²(φ/2) appears:
//     ρ² = a + b σ,  a = (r - r0)^2 + (z - z0)^2,  b = 4 r r0,
// so that nothing cancels when source and target approach each other.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace endoflow::boundary_integral {

/// Source points of one target, structure of arrays; every vector has the same length. Differences to the target are
/// inputs, so a caller who knows them to full relative accuracy (same element of a polynomial curve) keeps that
/// accuracy.
struct RingSources {
    std::vector<double> radius;         // r of the source, > 0 [nm]
    std::vector<double> delta_r;        // r - r0 [nm]
    std::vector<double> delta_z;        // z - z0 [nm]
    std::vector<double> normal_r;       // r component of the unit normal at the source
    std::vector<double> normal_offset;  // n_r (r - r0) + n_z (z - z0) [nm]

    void resize(std::size_t count);
    [[nodiscard]] std::size_t size() const { return radius.size(); }
};

/// Kernels of one azimuthal mode: [component at the target][component of the density], one entry per source. The
/// surface measure r ds is NOT included.
template <std::size_t components>
struct LayerKernels {
    using Values = std::array<std::array<std::vector<double>, components>, components>;
    Values single;   // G_ij [1/nm]
    Values doubled;  // T_ijk n_k [1/nm²]

    void resize(std::size_t count) {
        for (Values* values : {&single, &doubled}) {
            for (auto& of_target : *values) {
                for (auto& of_density : of_target) of_density.resize(count);
            }
        }
    }
};

/// Axisymmetric flow without swirl: components r, z.
using RingKernels = LayerKernels<2>;

/// Complete elliptic integrals from one arithmetic-geometric mean, all free of cancellation as m -> 0:
///     K, E, D = (K - E)/m, B = (E - (1-m) K)/m = K - D.  Argument: the complementary parameter 1 - m in (0, 1].
struct EllipticIntegrals {
    double k, e, d, b;
};
[[nodiscard]] EllipticIntegrals elliptic_integrals(double complementary_parameter);

/// All eight kernels for one target radius r0 ≥ 0 (the axis r0 = 0 needs no special case).
void evaluate_ring_kernels(double target_radius, const RingSources& sources, RingKernels& kernels);

/// The kernel set of axisymmetric flow; valid until the next call.
class AxisymmetricKernels {
  public:
    std::span<const RingKernels> operator()(double target_radius, const RingSources& sources) {
        evaluate_ring_kernels(target_radius, sources, kernels_);
        return {&kernels_, 1};
    }

  private:
    RingKernels kernels_;
};

/// Densities of layers at the sources, times the measure r ds: f of the single layer, u of the double layer, q of the
/// pressure's kernel x / ρ³ (source's frame).
struct RingDensities {
    std::vector<double> force_r, force_z;        // pN
    std::vector<double> momentum_r, momentum_z;  // pN nm
    std::vector<double> pressure_r, pressure_z;  // pN

    void resize(std::size_t count);
};

/// What each source adds: G f - (T.n) u by component [pN/nm], and ∫ x.q / ρ³ dφ [pN/nm²].
struct RingContributions {
    std::vector<double> momentum_r, momentum_z, pressure;
};

/// Velocity and pressure of the first `count` sources from one evaluation of the elliptic integrals.
void evaluate_ring_layers(double target_radius, std::size_t count, const RingSources& sources,
                          const RingDensities& densities, RingContributions& contributions);

/// The four single-layer kernels alone.
void evaluate_ring_stokeslets(double target_radius, const RingSources& sources, RingKernels& kernels);

}  // namespace endoflow::boundary_integral
