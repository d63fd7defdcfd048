#pragma once

// The point of the membrane that is closest to a target off it.

#include "boundary_integral/membrane/membrane_space.h"
#include "boundary_integral/operators/layer_target.h"
#include "boundary_integral/quadrature/singular_rules.h"

namespace endoflow::boundary_integral {

[[nodiscard]] double squared_distance(const CurvePoint& p, const Target& target);  // nm²

struct ClosestPoint {
    double xi;
    CurvePoint point;
};

/// Closest point of one element by Newton's method from a guess in it, e.g. its closest Gauss point.
[[nodiscard]] ClosestPoint closest_on_element(const MembraneSpace& space, const MembraneState& state, Index element,
                                              const Target& target, double guess);

/// The rule on an element that is near to a target off it, about its closest point, which is sought from `guess`.
[[nodiscard]] OffsetRule near_element_rule(const MembraneSpace& space, const MembraneState& state, Index element,
                                           const Target& target, double guess, const QuadratureRule& base);

/// Closest point of the whole membrane; the Gauss points tell the element. Of a target more than two lengths of an
/// element away, the closest Gauss point: it tells the side.
[[nodiscard]] ClosestPoint closest_on_membrane(const MembraneSpace& space, const MembraneState& state,
                                               const MembraneSamples& samples, const Target& target);

}  // namespace endoflow::boundary_integral
