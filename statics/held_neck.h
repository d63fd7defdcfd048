#pragma once

#include <functional>
#include <optional>

#include "statics/piecewise_solution.h"
#include "statics/shape_equations.h"

namespace endoflow::statics {

// A stationary membrane whose neck is held at a radius R. The shape makes 𝒢 stationary among those with r = R at their
// narrowest place, so that a radial force f = d𝒢/dR acts there. docs/statics.md derives it.
//
// Two meridians meet at the neck, the bud's from the axis and the outer one from the rim, both with x = 1 there: at x
// the labels are a = a_n x and a = E − (E − a_n) x. The n states of a point (shape_equations.h) are those of the bud,
// and again, as states n … 2n − 1, those of the outer membrane.

/// Indices of the global unknowns.
namespace held_global {
inline constexpr Eigen::Index area = 0;       // E, membrane area over 2π, nm²
inline constexpr Eigen::Index neck = 1;       // a_n, the label of the neck, nm²
inline constexpr Eigen::Index force = 2;      // f, radial force that holds the neck, > 0 outwards, pN
inline constexpr Eigen::Index potential = 3;  // μ, see global::potential; only of molecules in equilibrium
}  // namespace held_global

/// A case and the radius (nm) at which its neck is held.
struct HeldCase {
    StationaryCase stationary;
    double radius;
};

/// Makes a case with a held neck out of the value of the parameter that varies.
using HeldPath = std::function<HeldCase(double)>;

/// The stationary shapes with held necks along a path. `scale` is a typical change of the path's parameter.
[[nodiscard]] BoundaryValueProblem held_shapes(const HeldPath& path, double typical_value, double scale);

/// The whole membrane of a solution of held_shapes() as one of stationary_shapes(). Q jumps between two elements, at
/// the neck, where the node has the outer membrane's.
[[nodiscard]] PiecewiseSolution joined(const PiecewiseSolution& held, const GaussRule& rule);

/// A solution of stationary_shapes() cut at x_n, where its neck is, as one of held_shapes() without force, on
/// `elements` elements of equal width.
[[nodiscard]] PiecewiseSolution cut_at_neck(const PiecewiseSolution& solution, const GaussRule& rule, double x_n,
                                            std::size_t elements);

/// The narrowest place x of a solution of stationary_shapes() between two wider ones, found to round-off; empty when
/// there is none.
[[nodiscard]] std::optional<double> place_of_neck(const PiecewiseSolution& solution, const GaussRule& rule);

}  // namespace endoflow::statics
