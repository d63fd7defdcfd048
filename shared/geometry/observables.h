#pragma once

#include <optional>

#include "shared/geometry/membrane_curve.h"
#include "shared/model/bending_model.h"

namespace endoflow {

/// The neck is the narrowest place between the bud's widest place and the rim.
struct Neck {
    double radius;            // nm
    double z;                 // nm
    double s;                 // arc length from the axis, nm
    double lateral_diameter;  // of the bud above it: twice the largest r between axis and neck, nm
};

/// Budding is the event that the neck radius falls below this, nm (Sec. 4.4).
inline constexpr double budding_neck_radius = 5.0;

/// What can be measured on a membrane curve. Lengths in nm.
struct Observables {
    std::optional<Neck> neck;
    double bud_height;            // largest z − z(rim)
    double membrane_area;         // ∫ dA, nm²
    double molecule_mass;         // ∫ c dA, nm²
    double bending_energy;        // (S) with the curve's own κ, pN nm
    double extracellular_volume;  // gained against the plane through the rim: ∫ (z − z(rim)) 2πr dr, nm³
};

/// Throws std::invalid_argument unless the curve has at least 4 points and starts on the axis.
/// Positions are splined (cubic, mirrored at the axis), so the error is O(h⁴) in the spacing of the points.
[[nodiscard]] Observables measure(const MembraneCurve& curve, const BendingModel& model);

/// The neck alone; empty when r grows all the way from the axis to the rim.
[[nodiscard]] std::optional<Neck> find_neck(const MembraneCurve& curve);

}  // namespace endoflow
