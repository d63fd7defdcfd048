#pragma once

#include <cmath>

#include "phasefield/contour/layer_thickness.h"
#include "phasefield/contour/material_force.h"
#include "phasefield/layer/constants.h"
#include "phasefield/layer/profile.h"
#include "phasefield/layer/weights.h"
#include "phasefield/schemes/production/fields.h"
#include "shared/model/bending_model.h"
#include "shared/numerics/forward.h"

namespace endoflow::phasefield::production {

/// A vector of the half plane.
template <class Number>
struct PlaneVector {
    Number r{}, z{};
};
using Direction = PlaneVector<double>;  // a unit vector; shorter where normals cross

/// Of any two with components along r and z.
template <class A, class B>
auto dot(const A& a, const B& b) {
    return a.r * b.r + a.z * b.z;
}

/// t·∇y, t = (−N_z, N_r).
template <class Number, class Vector>
Number along_sheet(const AtPoint<Number>& y, const Vector& N) {
    return y.z * N.r - y.r * N.z;
}

/// What is known at a point besides the iterate: Σ_j a_j y(t_j) of the past for every quantity with a time derivative,
/// and of the predicted ψ the normal, at which most alignment aims.
struct PointPast {
    double distance = 0;    // of ψ
    double indicator = 0;   // of H_Γ
    double molecules = 0;   // of δ_Γ c
    double stretching = 0;  // of δ_Γ s
    double velocity_r = 0, velocity_z = 0;
    Direction normal;                 // N = ∇ψ/|∇ψ|; far from the membrane that of its closest point
    Direction molecules_normal;       // the same with the error of BDF, for c
    double own = 1;                   // part of ψ's gradient in its own normal, the rest is the closest point's
    Direction closest;                // normal of the membrane's closest point
    double slope_r = 0, slope_z = 0;  // ∇Σ_j a_j ψ(t_j)
    PointThickness thickness;         // ε, the same for all times
    double arc = 1, metric = 1;       // sheet_arc, sheet_metric
    double even = 1;                  // evenness
    ForceDensity material_force;      // what rides on the material
    double bulk = 1;                  // c_b/c_∞ of the fluid that molecules come from
};

/// What the equations need of ψ's second derivatives [1/nm]: N·∇∇ψ with ψ's own normal, how ∇ψ changes along the
/// normal, 0 where ψ is a distance, and Δψ.
template <class Number>
struct GradientChange {
    Number r{}, z{};
    Number laplacian{};
};

/// From ψ's second derivatives; `around` is ψ_r/r.
template <class Number>
GradientChange<Number> gradient_change(const PlaneVector<Number>& n, const Number& rr, const Number& rz,
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

template <class Number>
Number inverse_root(const Number& x) {
    const double value = value_of(x), f = 1 / std::sqrt(value);
    return chain(x, f, -0.5 * f / value, 0.75 * f / (value * value));
}

/// Along (r, z), shorter where that is below shortest_gradient.
template <class Number>
PlaneVector<Number> direction(const Number& r, const Number& z) {
    constexpr double shortest = constant("shortest_gradient");
    const Number square = r * r + z * z;
    if (value_of(square) < shortest * shortest) return {(1 / shortest) * r, (1 / shortest) * z};
    const Number inverse = inverse_root(square);
    return {inverse * r, inverse * z};
}

/// ψ's own normal, at which the alignment of G aims: a predicted one, turned by as little as a step's error, shifts the
/// force, some 10 pN/nm, along the membrane, which follows within nanoseconds, and the next prediction with it.
template <class Number>
PlaneVector<Number> own_normal(const AtPoint<Number>& psi, const PointPast& past) {
    const double rest = 1 - past.own;
    return direction<Number>(past.own * psi.r + rest * past.closest.r, past.own * psi.z + rest * past.closest.z);
}

/// N_ε = g/|g|, normal to the layer's sheets of constant ψ/ε: g = ε ∇(ψ/ε) = ∇ψ − (ψ/ε) ∇ε.
template <class Number>
struct SheetNormal {
    PlaneVector<Number> N_epsilon;
    Number inverse_g;  // 1/|g|
};
template <class Number>
SheetNormal<Number> sheet_normal(const AtPoint<Number>& psi, const PointThickness& thickness) {
    const Number relative = (1 / thickness.value) * psi.value;
    const PlaneVector<Number> g{psi.r - thickness.r * relative, psi.z - thickness.z * relative};
    const Number inverse = inverse_root(dot(g, g) + gradient_floor * gradient_floor);
    return {{g.r * inverse, g.z * inverse}, inverse};
}

/// What the rows share.
template <class Number>
struct PointGeometry {
    double epsilon;  // here [nm]
    LayerProfile<Number> layer;
    ScaledEnergyWeight scaled_delta_E;
    Number delta_floored, delta_Gamma, delta_N, delta_E;  // δ with a floor, δ_Γ, δ_N, δ_E [1/nm]
    Number H_Gamma;
    PlaneVector<Number> N_epsilon, own_normal;
    Number inverse_g, squared_gradient;  // 1/|g|, |∇ψ|²
};
template <class Number>
PointGeometry<Number> point_geometry(const AtPoint<Number>& psi, const PointPast& past, const MembraneWeight& weight) {
    const double epsilon = past.thickness.value;
    const auto layer = layer_profile(psi.value, epsilon);
    const Number density = delta_Gamma(layer, weight);
    const ScaledEnergyWeight scaled(value_of(layer.phi));
    const auto [N_epsilon, inverse_g] = sheet_normal(psi, past.thickness);
    return {epsilon,
            layer,
            scaled,
            layer.delta + surface_floor / epsilon,
            density,
            delta_N(layer),
            energy_weight(psi.value, epsilon, scaled).value,
            chain(psi.value, H_Gamma(value_of(layer.phi), weight), value_of(density)),
            N_epsilon,
            own_normal(psi, past),
            inverse_g,
            dot(psi, psi)};
}

template <class Number>
void add_flux(const PlaneVector<Number>& flux, AtPoint<Number>& row) {
    row.r += flux.r;
    row.z += flux.z;
}

}  // namespace endoflow::phasefield::production
