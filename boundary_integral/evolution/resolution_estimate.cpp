#include "boundary_integral/evolution/resolution_estimate.h"

#include <algorithm>
#include <cmath>

namespace endoflow::boundary_integral {

ResolutionEstimate estimate_resolution(const MembraneSpace& space, const MembraneState& state) {
    const double width = space.element_width(), unit = std::pow(width, 5);
    ResolutionEstimate found;
    for (Index right = 1; right < space.elements(); ++right) {
        const double xi = static_cast<double>(right) * width;
        const auto jump = [&](const SplineSpace& spline, const Eigen::VectorXd& coefficients) {
            return unit * (spline.taylor(coefficients, xi, right)[5] - spline.taylor(coefficients, xi, right - 1)[5]);
        };
        const CurvePoint p = curve_point(space.radial().basis(xi, right), space.axial().basis(xi, right), state);
        const double curvature = std::max(std::abs(p.meridional_curvature), std::abs(p.azimuthal_curvature));
        const double position = std::hypot(jump(space.radial(), state.r), jump(space.axial(), state.z));
        found.curve = std::max(found.curve, curvature * position);
        found.concentration = std::max(found.concentration, std::abs(jump(space.axial(), state.c)));
    }
    return found;
}

}  // namespace endoflow::boundary_integral
