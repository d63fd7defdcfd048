#pragma once

#include "shared/numerics/gauss_legendre.h"

namespace endoflow::boundary_integral {

/// Quadrature on [begin, end] for integrands that are nearly singular at the parameter `closest`, whose singularity in
/// the complex plane lies at the distance `width` (in parameter units) from it: t = closest + width sinh(η),
/// Gauss-Legendre in η on each side of `closest` (Johnston & Elliott 2005). `base` is the rule used on each side.
/// Nodes are appended as offsets t - closest, which keeps their full relative accuracy.
struct OffsetRule {
    double origin = 0.0;  // `closest`, clamped into [begin, end]
    std::vector<double> offsets;
    std::vector<double> weights;
};

[[nodiscard]] OffsetRule near_singular_rule(double begin, double end, double closest, double width,
                                            const QuadratureRule& base);

/// For logarithmic singularities at `closest` in [begin, end]: t = closest + L x³ on each side; the error of the
/// n-point rule for log|t - closest| decays like n^-6 and that of smooth factors spectrally.
[[nodiscard]] OffsetRule logarithmic_rule(double begin, double end, double closest, const QuadratureRule& base);

}  // namespace endoflow::boundary_integral
