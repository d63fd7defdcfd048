#pragma once

#include <cmath>

#include "phasefield/schemes/production/point_geometry.h"
#include "shared/model/bending_model.h"

namespace endoflow::phasefield::production {

inline constexpr double moment_floor = constant("moment_floor");
inline constexpr double moment_alignment = constant("moment_alignment");

/// β, C and their derivatives with respect to c as functions of c.
template <class Number>
struct Stiffness {
    Number beta, beta_c, curvature, curvature_c;
};

/// c as the laws see it: c itself on [0, 1], bent smoothly to stay within a twentieth of it outside. A sharp limit
/// would switch derivatives on and off where c is 1 but for round-off, and Newton's method would not converge.
template <class Number>
Number limited_concentration(const Number& c) {
    constexpr double margin = constant("concentration_margin");
    const double value = value_of(c), edge = value < 0 ? 0 : 1;
    if (value >= 0 && value <= 1) return c;
    const double t = std::tanh((value - edge) / margin);
    return chain(c, edge + margin * t, 1 - t * t);
}

template <class Number>
Stiffness<Number> stiffness_of(const Number& concentration, const BendingModel& model) {
    const Number c = limited_concentration(concentration);
    const auto beta = model.stiffness(value_of(c)), C = model.spontaneous_curvature(value_of(c));
    return {chain(c, beta.value, beta.first), chain(c, beta.first, beta.second), chain(c, C.value, C.first),
            chain(c, C.first, C.second)};
}

/// ∂/∂c of the energy per area, ½ β K² with K = h + C, at a given shape [pN/nm].
template <class Number>
Number molecular_energy(const Number& b, const Number& K, const Stiffness<Number>& m) {
    return b * m.curvature_c + 0.5 * K * K * m.beta_c;
}

/// What compliance along the normal the last term of the energy below has: D [nm²/(pN nm)].
inline double moment_compliance(double epsilon, const BendingModel& model) {
    return moment_alignment * epsilon * epsilon / model.stiffness(0).value;
}
inline double moment_smoothing(double epsilon, const BendingModel& model) {
    return moment_floor * epsilon / model.stiffness(0).value;
}

/// The energy below per volume where it is stationary over b, when it is half its part linear in b [pN/nm²].
inline double moment_energy(const AtPoint<double>& b, const AtPoint<double>& psi, double K, double weight,
                            double epsilon, const BendingModel& model) {
    const double slope = psi.r * b.r + psi.z * b.z;
    return 0.5 * weight * (b.value * K + moment_compliance(epsilon, model) * slope * slope) +
           0.5 * moment_smoothing(epsilon, model) * (b.r * b.r + b.z * b.z);
}

/// The bending energy as a functional of ψ, the moment b and c whose stationary value over b is E:
///
///   E = ∫ w b h + w (b C − b²/(2 β)) − ½ D w (∇ψ·∇b)² dx,   h = Δψ − w' (1 − |∇ψ|²)/(2w),   w the weight above,
///
/// the Laplacian of ψ integrated by parts, with what w depends on x by ε taken off: b ∂w/∂ε ∇ε·∇ψ. With w = δ this h is
/// the one at the top of this page; with another h a weight that is cut off exerts a force on curved membranes, one
/// that does not vanish with ε. The last term keeps b constant along the normal: a sharp membrane has one curvature,
/// not one for each level set. Its derivatives with respect to b, ψ and c are the rows of b and of the normal force G
/// and the force e ∇c, so that the discrete equations obey the energy law. G is kept constant along the normal: what
/// varies there is the force that keeps the profile, which the profile's relaxation takes over. Acting on the fluid it
/// would drive a flow within the layer that the relaxation undoes all the time. Returns e [pN/nm], cut off in the
/// tails, too.
template <class Number>
Number add_bending(const Fields<Number>& x, const PointGeometry<Number>& p, const BendingModel& model,
                   const PointPast& past, Fields<Number>& row) {
    const auto &psi = x[distance], &b = x[moment];
    const Stiffness<Number> m = stiffness_of(x[molecule_density].value, model);
    const EnergyWeight<Number> w = energy_weight(p.layer, psi.value, p.epsilon);
    const Number K = b.value / m.beta, density = 0.5 * K * b.value, mean = 0.5 * (1.0 + p.squared_gradient);
    const double smoothing = moment_smoothing(p.epsilon, model);
    row[moment] = {w.value * (K - m.curvature) + w.first * mean, w.value * psi.r + smoothing * b.r,
                   w.value * psi.z + smoothing * b.z};
    const auto& thickness = past.thickness;
    const Number thinning = thickness.r * psi.r + thickness.z * psi.z, twist = w.first * b.value;
    row[moment].value += w.thickness * thinning;
    row[normal_force] = {(p.density + surface_floor / p.epsilon) * x[normal_force].value +
                             w.first * (psi.r * b.r + psi.z * b.z - m.curvature * b.value + density) +
                             w.second * mean * b.value + w.thickness_1 * b.value * thinning,
                         w.value * b.r + twist * psi.r + (thickness.r * w.thickness) * b.value,
                         w.value * b.z + twist * psi.z + (thickness.z * w.thickness) * b.value};
    add_alignment(x[normal_force], past.normal, force_diffusivity(p), row[normal_force]);
    const double compliance = moment_compliance(p.epsilon, model);
    const Number slope = psi.r * b.r + psi.z * b.z, flux = compliance * w.value * slope;
    row[moment].r += flux * psi.r;
    row[moment].z += flux * psi.z;
    row[normal_force].value += (0.5 * compliance) * w.first * slope * slope;
    row[normal_force].r += flux * b.r;
    row[normal_force].z += flux * b.z;
    return w.kept * molecular_energy(b.value, K, m);
}

}  // namespace endoflow::phasefield::production
