#pragma once

#include "shared/model/double_well.h"
#include "shared/model/membrane_energy.h"

namespace endoflow {

/// σ̂ (½ ε_c |∇_Γ c|² + W(c)/ε_c): the coat's edge, when flat, costs σ̂ √2/6 per length.
struct LineEnergyTerm {
    double strength;  // σ̂, pN
    double width;     // ε_c, nm

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        const ValueAndDerivatives well = double_well(value_of(x.concentration));
        return strength * (0.5 * width * x.squared_gradient +
                           chain(x.concentration, well.value / width, well.first / width, well.second / width));
    }
};

}  // namespace endoflow
