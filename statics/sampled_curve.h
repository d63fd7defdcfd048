#pragma once

#include "shared/geometry/membrane_curve.h"
#include "shared/parameters/parameters.h"
#include "statics/piecewise_solution.h"
#include "statics/vesicle_state.h"

namespace endoflow::statics {

/// The membrane of a solution of stationary_shapes() at `points` points of nearly equal distance, at rest.
/// With 1000 points, what is measured on its splines is accurate to about 1e-9.
[[nodiscard]] MembraneCurve sampled_curve(const Parameters& parameters, const PiecewiseSolution& solution,
                                          const GaussRule& rule, std::size_t points);

/// The same of a vesicle, from pole to pole, its poles at equal distances from z = `centre`.
[[nodiscard]] MembraneCurve sampled_curve(const VesicleState& state, const GaussRule& rule, double centre,
                                          std::size_t points);

/// The narrowest place between two wider ones among the mesh points, nm; infinite when there is none.
[[nodiscard]] double narrowest_radius(const PiecewiseSolution& solution);

}  // namespace endoflow::statics
