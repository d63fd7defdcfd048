#pragma once

#include <optional>

#include "shared/geometry/membrane_curve.h"
#include "shared/geometry/meridian.h"
#include "shared/model/bending_model.h"

namespace endoflow {

/// What can be measured on the membrane's shape alone.
struct ShapeMeasures {
    std::optional<Neck> neck;
    double bud_height = 0;            ///< largest z − z(rim); of a closed curve largest less smallest z, nm
    double membrane_area = 0;         ///< ∫ dA, nm²
    double extracellular_volume = 0;  ///< gained against the plane through the rim: ∫ (z − z(rim)) 2πr dr, nm³; of a
                                      ///< closed curve what it encloses
};

/// What can be measured on a membrane with its molecules.
struct Observables : ShapeMeasures {
    double molecule_mass = 0;   ///< ∫ c dA, nm²
    double bending_energy = 0;  ///< (S) with the curve's own κ, pN nm
};

/// Throws std::invalid_argument unless the curve has at least 4 points and starts on the axis.
/// Positions are splined (cubic, mirrored where the curve meets the axis), so the error is O(h⁴) in the spacing of the
/// points.
[[nodiscard]] Observables measure(const MembraneCurve& curve, const BendingModel& model);

}  // namespace endoflow
