#pragma once

// Numbers of a bud as linear functions of the normal displacement of one mode.

#include "boundary_integral/modes/surroundings.h"
#include "shared/geometry/meridian.h"

namespace endoflow::boundary_integral {

/// The quantity changes by row . (free coefficients of w) under w cos(m phi).
struct NoisyQuantity {
    int mode;
    Eigen::RowVectorXd row;
};

/// Of the pole over the rim's plane, m = 0, nm.
[[nodiscard]] NoisyQuantity pole_height(const Surroundings& surroundings, const BaseState& base);

struct BudQuantities {
    NoisyQuantity neck;              // its radius, m = 0, nm: r is stationary there, so that w n_r is all of it
    NoisyQuantity sideways;          // x of the centre of the volume above the neck's plane, m = 1, nm
    NoisyQuantity ellipticity;       // of that volume: int (x^2 - y^2) dV/(2 int (x^2 + y^2) dV), m = 2
    NoisyQuantity neck_ellipticity;  // (a - b)/(a + b) of the neck's axes along x and y, m = 2
};

/// Of the bud between pole and neck. The ellipticity of a cylinder is (a - b)/(a + b), too.
[[nodiscard]] BudQuantities bud_quantities(const Surroundings& surroundings, const BaseState& base, const Neck& neck);

}  // namespace endoflow::boundary_integral
