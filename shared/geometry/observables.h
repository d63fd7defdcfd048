#pragma once

#include <optional>

#include "shared/geometry/membrane_curve.h"
#include "shared/geometry/meridian.h"
#include "shared/model/bending_model.h"

namespace endoflow {

/// What can be measured on the membrane's shape alone.
struct ShapeMeasures {
    std::optional<Neck> neck;
    double bud_height = 0;            ///< bud_height_between() its highest and lowest point, nm
    double membrane_area = 0;         ///< ∫ dA, nm²
    double extracellular_volume = 0;  ///< gained against the plane through the rim: ∫ (z − z(rim)) 2πr dr, nm³; of a
                                      ///< closed curve what it encloses
};

/// What can be measured on a membrane with its molecules.
struct Observables : ShapeMeasures {
    double molecule_mass = 0;   ///< ∫ c dA, nm²
    double bending_energy = 0;  ///< (S) with the curve's own κ, pN nm
};

/// z − z(rim) of the point that is farthest from the rim's plane: > 0 for a bud into the cell, < 0 for one out of it,
/// so that a mirrored membrane has the opposite height. Of a closed curve its largest less its smallest z. nm
[[nodiscard]] double bud_height_between(double highest, double lowest, double rim, bool closed);

/// Throws std::invalid_argument unless the curve has at least 4 points and starts on the axis.
/// Positions are splined (cubic, mirrored where the curve meets the axis), so the error is O(h⁴) in the spacing of the
/// points.
[[nodiscard]] Observables measure(const MembraneCurve& curve, const BendingModel& model);

}  // namespace endoflow
