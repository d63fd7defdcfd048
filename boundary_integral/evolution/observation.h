#pragma once

// What a run reports about a state: exact integrals and extrema of the spline curve.

#include <optional>
#include <vector>

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "shared/geometry/membrane_curve.h"
#include "shared/geometry/observables.h"
#include "shared/geometry/wall_distance.h"

namespace endoflow::boundary_integral {

/// The neck of the spline curve; its t is ξ.
[[nodiscard]] std::optional<Neck> find_neck(const MembraneSpace& space, const MembraneState& state);

/// The membrane's area between the axis and ξ, nm².
[[nodiscard]] double area_within(const MembraneSpace& space, const MembraneState& state, double xi);

/// What observables.h defines, of the spline curve itself: exact integrals and extrema over the Gauss points.
[[nodiscard]] ShapeMeasures measure_shape(const MembraneSpace& space, const MembraneState& state,
                                          const DomainParameters& domain);
/// ∫ c dA, nm².
[[nodiscard]] double molecule_mass(const MembraneSpace& space, const MembraneSamples& samples);
/// Of the Gauss points.
[[nodiscard]] WallDistance wall_distance(const MembraneSpace& space, const MembraneSamples& samples,
                                         const DomainParameters& domain);

/// M c', c' being the rate of c at fixed ξ of the moving mesh: m' − M' c with M' c = ∫ φ c D(r g)[w] dξ, w the mesh
/// velocity.
[[nodiscard]] Eigen::VectorXd moments_of_concentration_rate(const MembraneDynamics& dynamics,
                                                            const Evaluation& evaluation);

/// Energy balance of a state: rate of E along the computed motion against the power given to the fluid, the energy that
/// inflowing membrane brings along and the energy that diffusion of the molecules brings.
struct EnergyBalance {
    double energy;                 // pN nm
    double energy_rate;            // dE/dt, pN nm/µs
    double dissipated_power;       // ∫ f.u dA, pN nm/µs
    double diffusive_power;        // dE/dt by all that changes c in the material, pN nm/µs
    double external_power;         // of the loads, pN nm/µs
    double molecular_dissipation;  // ∫ M |∇μ|² of energetic coupling, pN nm/µs
    double exchange_power;         // dE/dt by molecules that come and go, pN nm/µs
    double maturation_power;       // ∂E/∂χ dχ/dt, pN nm/µs
    /// Of the powers that only a motion, or exchange, has.
    [[nodiscard]] double moduli() const;
    /// What the powers do not account for, relative to their moduli, or to `floor` where that is larger.
    [[nodiscard]] double residual(double floor = 0.0) const;
};
[[nodiscard]] EnergyBalance energy_balance(const MembraneDynamics& dynamics, const Evaluation& evaluation);

/// Steps of ξ on each element of the curves that a run writes.
inline constexpr Index shape_points_per_element = 8;

/// Samples the curve with all its fields at equal steps of ξ, both ends included.
class CurveSampler {
  public:
    CurveSampler(const MembraneSpace& space, Index intervals);
    [[nodiscard]] MembraneCurve operator()(const MembraneState& state, const FlowSolution& flow) const;

  private:
    struct Point {
        BasisRow radial, axial, tension;
    };
    const MembraneSpace& space_;
    std::vector<Point> points_;
    std::vector<Point> between_;  // Gauss points of every interval, for the arc length
};

}  // namespace endoflow::boundary_integral
