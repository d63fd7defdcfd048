#pragma once

#include "boundary_integral/membrane/membrane_space.h"

namespace endoflow::boundary_integral {

/// How well the elements resolve a state. A quintic spline's fifth derivative jumps from element to element; times h⁵
/// the jump is the sixth difference of its coefficients, h⁶ times the sixth derivative of what is resolved.
struct ResolutionEstimate {
    double curve = 0.0;          ///< largest jump of the position over the local radius of curvature
    double concentration = 0.0;  ///< largest jump of c

    /// Relative error of neck radius and budding time that membranes with such jumps have had. Both are functionals of
    /// a variational method, whose errors go with the square: docs/boundary-integral.md has the measurements.
    [[nodiscard]] double relative_error() const { return 5e-3 * curve * curve + 1e-4 * concentration * concentration; }
};

[[nodiscard]] ResolutionEstimate estimate_resolution(const MembraneSpace& space, const MembraneState& state);

}  // namespace endoflow::boundary_integral
