#pragma once

#include <cmath>

#include "phasefield/schemes/production/equation_pattern.h"

namespace endoflow::phasefield::production {

template <class Number>
Number& part(AtPoint<Number>& at, std::size_t which) {
    return which == 0 ? at.value : which == 1 ? at.r : at.z;
}

/// A point in the middle of the layer, |∇ψ| ≠ 1, nothing zero.
inline Fields<double> some_point() {
    Fields<double> x;
    for (std::size_t k = 0; k < n_features; ++k)
        part(x[k / 3], k % 3) = 0.3 + 0.5 * std::sin(1.7 * static_cast<double>(k) + 0.4);
    x[molecule_density].value = 0.6;
    x[membrane_stretch].value = 1.1;
    return x;
}

}  // namespace endoflow::phasefield::production
