#pragma once

#include "shared/model/bending_model.h"

namespace endoflow {

/// Double well of the surface Cahn-Hilliard equation (24): W = c²(1 − c)², W' = 4c³ − 6c² + 2c, W''.
[[nodiscard]] constexpr ValueAndDerivatives double_well(double c) {
    return {c * c * (1 - c) * (1 - c), 2 * c * (1 - c) * (1 - 2 * c), 2 + 12 * c * (c - 1)};
}

/// The double well's third derivative.
[[nodiscard]] constexpr double double_well_third(double c) {
    return 24 * c - 12;
}

}  // namespace endoflow
