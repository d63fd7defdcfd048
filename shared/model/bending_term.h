#pragma once

#include "shared/model/bending_model.h"
#include "shared/model/membrane_energy.h"

namespace endoflow {

/// (S): e = ½ β(c) (κ − C(c))².
struct BendingTerm {
    BendingModel model;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        const double c = value_of(x.concentration);
        const auto beta = model.stiffness(c), spontaneous = model.spontaneous_curvature(c);
        const Number excess =
            x.curvature - chain(x.concentration, spontaneous.value, spontaneous.first, spontaneous.second);
        return 0.5 * chain(x.concentration, beta.value, beta.first, beta.second) * excess * excess;
    }
};

}  // namespace endoflow
