#pragma once

#include <array>

#include "shared/geometry/membrane_curve.h"

namespace endoflow {

/// A column of a recorded shape.
struct ShapeColumn {
    const char* name;
    const char* unit;
    const char* meaning;
    std::vector<double> MembraneCurve::*values;
};

inline constexpr std::array shape_columns{
    ShapeColumn{"s", "nm", "arc length from the axis", &MembraneCurve::s},
    ShapeColumn{"r", "nm", "distance from the axis", &MembraneCurve::r},
    ShapeColumn{"z", "nm", "height", &MembraneCurve::z},
    ShapeColumn{"c", "1", "concentration of curvature-inducing molecules", &MembraneCurve::c},
    ShapeColumn{"lambda", "pN/nm", "membrane tension of the sharp model", &MembraneCurve::lambda},
    ShapeColumn{"kappa", "1/nm", "total curvature, positive on an endocytic bud", &MembraneCurve::kappa},
    ShapeColumn{"u_r", "nm/us", "radial velocity of the membrane material", &MembraneCurve::u_r},
    ShapeColumn{"u_z", "nm/us", "vertical velocity of the membrane material", &MembraneCurve::u_z},
};

/// Throws SolverError when a value is not finite.
void require_finite(const MembraneCurve& curve);

}  // namespace endoflow
