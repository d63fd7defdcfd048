#pragma once

// Where the elements go: the mesh follows the material, except for the inflow at the rim and a slow relaxation towards
// the element density that the coat edge and the curvature ask for. A material that may stretch can pile up at the
// coat's edge without limit: there the mesh follows only the normal motion.

#include <Eigen/Core>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/membrane/membrane_space.h"

namespace endoflow::boundary_integral {

/// Elements per arc length are proportional to
///     ρ = √(1 + (curvature_length)² (κ_m² + κ_p²) + (edge_length dc/ds)²)
/// so that the coat's edge has as many elements as that length of a flat membrane, however narrow it is.
struct MeshDensity {
    double curvature_length;  // nm
    double edge_length;       // nm
    double relaxation_time;   // µs
    double smoothing;         // ρ is filtered over this length in ξ, whatever the number of elements
};

enum class MeshCarrier { material, normal_motion };

class MeshMotion {
  public:
    MeshMotion(const MembraneSpace& space, const MeshDensity& density, MeshCarrier carrier);

    /// Tangential velocity field added to the material velocity, as coefficients (curve_count), nm/µs:
    ///     α t,  α = α_0 - (N - ξ) g / (τ N'),  α_0 = -inflow ξ⁵ or -u.t
    /// N(ξ): fraction of elements the density wants between the axis and ξ; N(1) = 1.
    [[nodiscard]] Eigen::VectorXd tangential_velocity(const MembraneState& state, const MembraneSamples& samples,
                                                      const Eigen::VectorXd& velocity, double inflow) const;

    /// The derivatives of its coefficients.
    struct Derivatives {
        Eigen::MatrixXd by_curve;          // curve_count x curve_count, at fixed c(ξ), velocity and inflow
        Eigen::MatrixXd by_concentration;  // curve_count x axial_count
        Eigen::VectorXd by_inflow;         // curve_count; zero when the mesh follows the normal motion
        Eigen::MatrixXd by_velocity;       // curve_count x curve_count; empty when the mesh follows the material
    };
    [[nodiscard]] Derivatives derivatives(const MembraneState& state, const MembraneSamples& samples,
                                          const Eigen::VectorXd& velocity, double inflow) const;

    /// N - ξ as radial coefficients.
    [[nodiscard]] Eigen::VectorXd numbers_ahead(const MembraneSamples& samples) const;

  private:
    const MembraneSpace& space_;
    MeshDensity density_;
    MeshCarrier carrier_;
    std::vector<double> radial_points_, axial_points_;  // Greville points of the two spaces
    Eigen::MatrixXd radial_interpolation_, axial_interpolation_, filter_, antiderivative_;  // inverses
    Eigen::VectorXd identity_;  // ξ itself in the radial space, as far as its ends let it

    [[nodiscard]] double wanted_density(const CurvePoint& p, double c1) const;
    [[nodiscard]] std::vector<double> filtered_density(const MembraneSamples& samples) const;  // at the Gauss points
    /// What carries the mesh off the material at one point, and its derivatives by x' and u.
    struct Slip {
        double speed;           // α_0, nm/µs
        double by_r1, by_z1;    // 1/µs
        double by_u_r, by_u_z;  // 1
        double by_inflow;       // 1
    };
    [[nodiscard]] Slip slip(double xi, const CurvePoint& p, double u_r, double u_z, double inflow) const;
    template <class Speed>
    [[nodiscard]] Eigen::VectorXd interpolate_tangential(const MembraneState& state, Speed speed) const;
};

/// Spline coefficients from values at the Greville points of a space.
class Interpolation {
  public:
    explicit Interpolation(const SplineSpace& space);
    [[nodiscard]] Eigen::VectorXd operator()(const std::vector<double>& values) const;

  private:
    LuFactors factors_;
};
[[nodiscard]] Eigen::VectorXd interpolate(const SplineSpace& space,
                                          const std::vector<double>& values_at_greville_points);

}  // namespace endoflow::boundary_integral
