#pragma once

// A point of the curve as seen from another one in the same polynomial piece.

#include <array>

namespace endoflow::boundary_integral {

struct CurveOffset {
    double r, z;    // x(ξ + t) - x(ξ), nm
    double normal;  // g n.(x(ξ + t) - x(ξ)) at ξ + t, nm²
};

/// From all derivatives of a quintic at ξ (SplineSpace::taylor). x - x0 and n.(x - x0) keep their relative accuracy
/// however small t is.
[[nodiscard]] inline CurveOffset curve_offset(const std::array<double, 6>& r, const std::array<double, 6>& z,
                                              double t) {
    // x - x0 = t (x' + t p),  x'(t) = x' + t q
    const auto p = [t](const std::array<double, 6>& d) {
        return d[2] / 2 + t * (d[3] / 6 + t * (d[4] / 24 + t * d[5] / 120));
    };
    const auto q = [t](const std::array<double, 6>& d) {
        return d[2] + t * (d[3] / 2 + t * (d[4] / 6 + t * d[5] / 24));
    };
    const double p_r = p(r), p_z = p(z), q_r = q(r), q_z = q(z);
    // g n.(x - x0) = r'(z - z0) - z'(r - r0) = t² [ x' x p + q x x' + t q x p ]
    return {t * (r[1] + t * p_r), t * (z[1] + t * p_z),
            t * t * ((r[1] * p_z - z[1] * p_r) + (q_r * z[1] - q_z * r[1]) + t * (q_r * p_z - q_z * p_r))};
}

}  // namespace endoflow::boundary_integral
