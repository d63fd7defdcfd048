#pragma once

#include <cmath>

#include "phasefield/layer/profile.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/fields.h"
#include "phasefield/schemes/production/layer_weights.h"
#include "phasefield/schemes/production/step_numbers.h"
#include "shared/model/bending_model.h"
#include "shared/numerics/forward.h"

namespace endoflow::phasefield::production {

/// A unit vector; shorter where normals cross.
template <class Number>
struct DirectionOf {
    Number r{}, z{};
};
using Direction = DirectionOf<double>;

/// What is known at a point besides the iterate: Σ_j a_j y(t_j) of the past for every quantity with a time derivative,
/// and of the predicted ψ the normal, at which most alignment aims.
struct PointPast {
    double distance = 0;    // of ψ
    double indicator = 0;   // of ∫ δ_m dψ
    double molecules = 0;   // of δ_m c
    double stretching = 0;  // of δ_m s
    double velocity_r = 0, velocity_z = 0;
    Direction normal;                 // n = ∇ψ/|∇ψ|; far from the membrane that of its closest point
    Direction molecules_normal;       // the same with the error of BDF, for c
    double own = 1;                   // part of ψ's gradient in its own normal, the rest is the closest point's
    Direction closest;                // normal of the membrane's closest point
    double slope_r = 0, slope_z = 0;  // ∇Σ_j a_j ψ(t_j)
    PointThickness thickness;         // ε, the same for all times
    double arc = 1, metric = 1;       // sheet_arc, sheet_metric
    double even = 1;                  // evenness
    double pole_force = 0;            // along z, per area of membrane [pN/nm²]
    double bulk = 1;                  // c_b/c_∞ of the fluid that molecules come from
};

/// What the equations need of ψ's second derivatives [1/nm]: n·∇∇ψ with ψ's own normal, how ∇ψ changes along the
/// normal, 0 where ψ is a distance, and Δψ.
template <class Number>
struct GradientChange {
    Number r{}, z{};
    Number laplacian{};
};

/// From ψ's second derivatives; `around` is ψ_r/r.
template <class Number>
GradientChange<Number> gradient_change(const DirectionOf<Number>& n, const Number& rr, const Number& rz,
                                       const Number& zz, const Number& around) {
    return {n.r * rr + n.z * rz, n.r * rz + n.z * zz, rr + zz + around};
}

/// x (1 + (x/bound)⁸)^(−1/8): smoothly below the bound, and x up to (x/bound)⁸/8 of itself.
ValueAndDerivatives bounded(double x, double bound);

/// 1 + κ₁ψ, κ₁ the membrane's curvature along the meridian: by how much the arcs of the sheet at the distance ψ are
/// longer than the membrane's. From the sheet's own curvatures κᵢ/(1 + κᵢψ): `around` the axis, ψ_r/r, and their sum
/// Δψ. κ₁ψ is kept below largest_sheet_bend, for normals may cross.
double sheet_arc(double psi, double around, double laplacian);

/// (1 + κ₁ψ)/(1 + κ₂ψ), κ₂ the membrane's curvature around the axis, in which circles are longer. From the same.
double sheet_metric(double psi, double around, double laplacian);

inline constexpr double uneven_fade = constant("uneven_fade");

/// 1 where ψ is a distance, little on the ridges where layers meet and normals turn round within a cell.
template <class Number>
Number evenness(const GradientChange<Number>& change, double epsilon) {
    const double bound = uneven_fade * epsilon;
    return 1.0 / (1.0 + bound * bound * (change.r * change.r + change.z * change.z));
}

inline constexpr double surface_floor = constant("surface_floor");
inline constexpr double gradient_floor = constant("gradient_floor");
inline constexpr double force_alignment = constant("force_alignment");
inline constexpr double step_alignment = constant("step_alignment");
inline constexpr double alignment_floor = constant("alignment_floor");

template <class Number>
Number inverse_root(const Number& x) {
    const double f = 1 / std::sqrt(value_of(x));
    return chain(x, f, -0.5 * f / value_of(x));
}

/// Along (r, z), shorter where that is below shortest_gradient.
template <class Number>
DirectionOf<Number> direction(const Number& r, const Number& z) {
    constexpr double shortest = constant("shortest_gradient");
    const Number square = r * r + z * z;
    if (value_of(square) < shortest * shortest) return {(1 / shortest) * r, (1 / shortest) * z};
    const Number inverse = inverse_root(square);
    return {inverse * r, inverse * z};
}

/// ψ's own normal, at which the alignment of G aims: a predicted one, turned by as little as a step's error, shifts the
/// force, some 10 pN/nm, along the membrane, which follows within nanoseconds, and the next prediction with it.
template <class Number>
DirectionOf<Number> own_normal(const AtPoint<Number>& psi, const PointPast& past) {
    const double rest = 1 - past.own;
    return direction<Number>(past.own * psi.r + rest * past.closest.r, past.own * psi.z + rest * past.closest.z);
}

/// g = ε ∇(ψ/ε) = ∇ψ − (ψ/ε) ∇ε, normal to the layer's sheets of constant ψ/ε.
template <class Number>
struct SheetGradient {
    Number r, z;
};
template <class Number>
SheetGradient<Number> sheet_gradient(const AtPoint<Number>& psi, const PointThickness& thickness) {
    const Number relative = (1 / thickness.value) * psi.value;
    return {psi.r - thickness.r * relative, psi.z - thickness.z * relative};
}

/// What the rows share.
template <class Number>
struct PointGeometry {
    double epsilon;  // here [nm]
    LayerProfile<Number> layer;
    Number surface, density;                                        // δ with a floor, δ_m [1/nm]
    Number indicator;                                               // ∫ δ_m dψ
    Number normal_r, normal_z, squared_gradient, inverse_gradient;  // of the sheets: g/|g|; |∇ψ|²; 1/|g|
};

/// Of ψ where the layer has this thickness.
template <class Number>
PointGeometry<Number> point_geometry(const AtPoint<Number>& psi, const PointThickness& thickness,
                                     const MembraneWeight& weight) {
    const double epsilon = thickness.value;
    const SheetGradient<Number> sheet = sheet_gradient(psi, thickness);
    const Number inverse = inverse_root(sheet.r * sheet.r + sheet.z * sheet.z + gradient_floor * gradient_floor);
    const auto layer = layer_profile(psi.value, epsilon);
    const Number density = membrane_density(layer, weight);
    return {epsilon,
            layer,
            layer.delta + surface_floor / epsilon,
            density,
            chain(psi.value, cut_indicator(value_of(layer.phi), weight), value_of(density)),
            sheet.r * inverse,
            sheet.z * inverse,
            psi.r * psi.r + psi.z * psi.z,
            inverse};
}

/// The part of g along the normal, (n n + (1 − |n|²))·g: all of it where normals cross and n vanishes.
template <class Normal, class Number>
Number normal_part(const DirectionOf<Normal>& n, const Normal& n_own, const Number& own, const Normal& n_other,
                   const Number& other) {
    return (1.0 - n.r * n.r - n.z * n.z + n_own * n_own) * own + (n_own * n_other) * other;
}

/// D_n ∇·(δ n n·∇y): keeps y constant along the normal, of most fields a predicted one, so that the term is linear. For
/// what belongs to one membrane D_n holds the evenness: where the layers of bud and plane meet, molecules would change
/// over, and tension.
template <class Normal, class Number>
void add_alignment(const AtPoint<Number>& y, const DirectionOf<Normal>& n, const Number& diffusivity,
                   AtPoint<Number>& row) {
    row.r += diffusivity * normal_part(n, n.r, y.r, n.z, y.z);
    row.z += diffusivity * normal_part(n, n.z, y.z, n.r, y.r);
}

/// D of G [nm²] times δ.
template <class Number>
Number force_diffusivity(const PointGeometry<Number>& p) {
    return (force_alignment * p.epsilon * p.epsilon) * p.surface;
}

template <class Number>
void add_diffusion(const AtPoint<Number>& y, const Number& diffusivity, AtPoint<Number>& row) {
    row.r += diffusivity * y.r;
    row.z += diffusivity * y.z;
}

/// Multipliers of conditions on the membrane are constant along the normal, and smooth far from the layer.
template <class Number>
void extend_multiplier(const AtPoint<Number>& y, const PointGeometry<Number>& p, const PointPast& past,
                       double alignment, double leak, AtPoint<Number>& row) {
    const Number phi2 = p.layer.phi * p.layer.phi;
    add_alignment(y, past.normal, -alignment * past.even * (p.layer.squared_well + alignment_floor), row);
    add_diffusion(y, -leak * (phi2 * phi2), row);
}

/// A diffusivity along the normal [nm²/µs] made fast within a step: δ_m is negative in the layer's tails, where without
/// it y would grow.
inline double within_a_step(double diffusivity, double epsilon, const StepNumbers& step) {
    return diffusivity + step_alignment * epsilon * epsilon * step.rate;
}

}  // namespace endoflow::phasefield::production
