#pragma once

// The discrete membrane: which spline spaces carry which unknown, and the quadrature points that integrate over it.

#include <vector>

#include <Eigen/Core>

#include "boundary_integral/splines/spline_space.h"
#include "shared/numerics/gauss_legendre.h"

namespace endoflow::boundary_integral {

/// Where the curve ends: at a rim of given place and slope, or on the axis again.
enum class CurveEnd { clamped, closed };

/// ξ in [0, 1] runs from the axis to the rim, or from the upper pole of a closed surface to the lower.
///   radial   quintic, odd:  r, u_r, f_r
///   axial    quintic, even: z, u_z, c
///   force    quintic, even, without the two breakpoints next to the rim: f_z. Two functions fewer than `axial`, as
///            many as the clamped velocities (height and slope prescribed at the rim) have freedoms.
///   tension  quartic, even: λ; holds the derivatives of `radial`
/// On a closed surface all of them are mirrored at both ends, and `force` is `axial`.
class MembraneSpace {
  public:
    MembraneSpace(Index elements, int gauss_points, CurveEnd end = CurveEnd::clamped);

    [[nodiscard]] CurveEnd end() const { return end_; }
    /// Coefficients that stay: the rim's radius; its height and slope.
    [[nodiscard]] Index fixed_radial() const { return end_ == CurveEnd::clamped ? 1 : 0; }
    [[nodiscard]] Index fixed_axial() const { return end_ == CurveEnd::clamped ? 2 : 0; }
    [[nodiscard]] Index elements() const { return elements_; }
    [[nodiscard]] double element_width() const { return 1.0 / static_cast<double>(elements_); }
    [[nodiscard]] const SplineSpace& radial() const { return radial_; }
    [[nodiscard]] const SplineSpace& axial() const { return axial_; }
    [[nodiscard]] const SplineSpace& force() const { return force_; }
    [[nodiscard]] const SplineSpace& tension() const { return tension_; }
    [[nodiscard]] Index radial_count() const { return radial_.dimension(); }
    [[nodiscard]] Index axial_count() const { return axial_.dimension(); }
    [[nodiscard]] Index curve_count() const { return radial_count() + axial_count(); }
    [[nodiscard]] Index force_count() const { return radial_count() + force_.dimension(); }

    /// Gauss points of all elements, and everything tabulated there.
    [[nodiscard]] Index points() const { return static_cast<Index>(xi.size()); }
    [[nodiscard]] Index points_per_element() const { return points_per_element_; }
    std::vector<double> xi;
    std::vector<double> weight;
    std::vector<BasisRow> radial_rows, axial_rows, force_rows, tension_rows;

    /// Where the velocity equation is collocated: radial component, axial component.
    std::vector<double> radial_targets, axial_targets;

  private:
    CurveEnd end_;
    Index elements_;
    Index points_per_element_;
    SplineSpace radial_, axial_, force_, tension_;
};

/// Spline coefficients of the curve and of the concentration on it.
struct MembraneState {
    Eigen::VectorXd r;  // radial_count, nm
    Eigen::VectorXd z;  // axial_count, nm
    Eigen::VectorXd c;  // axial_count
};

/// The curve at one point. t = (r', z')/g is the tangent towards the rim, n = (-z', r')/g the normal into the cell.
struct CurvePoint {
    double r, z, r1, z1, r2, z2;  // position [nm], first and second derivatives in ξ
    double g;                     // |x'| = ds/dξ [nm]
    double normal_r, normal_z;
    double meridional_curvature;  // -(r' z'' - z' r'')/g³
    double azimuthal_curvature;   // -z'/(r g), its limit on the axis
    double total_curvature() const { return meridional_curvature + azimuthal_curvature; }
    /// But for round-off.
    bool on_axis() const { return r <= 1e-12 * g; }
};

[[nodiscard]] CurvePoint curve_point(const BasisRow& radial, const BasisRow& axial, const MembraneState& state);

/// Curve and concentration at all Gauss points.
struct MembraneSamples {
    std::vector<CurvePoint> curve;
    std::vector<double> c, c1, c2;
    double rim_radius = 0.0;  // nm; 0 on a closed surface
};
[[nodiscard]] MembraneSamples sample(const MembraneSpace& space, const MembraneState& state);

/// Gauss points of the meridian between the pole and ξ, which may cut an element; `weight` integrates over ξ.
struct MeridianPoints {
    std::vector<double> xi, weight;
    std::vector<CurvePoint> curve;
};
[[nodiscard]] MeridianPoints points_before(const MembraneSpace& space, const MembraneState& state, double xi);

}  // namespace endoflow::boundary_integral
