#pragma once

#include <cmath>

#include "phasefield/production/dual.h"
#include "phasefield/production/fields.h"
#include "phasefield/weak_forms/bending.h"
#include "shared/model/double_well.h"

namespace endoflow::phasefield::production {

// The weak form of the production scheme at one point, written once: with plain numbers it is the residual, with duals
// its exact Jacobian. The unknown is ψ with φ = tanh(ψ/(√2 ε)), so that all fields are smooth across the layer.
//
//   δ(ψ) = 3 (1 − φ²)²/(4√2 ε),  ∫δ dψ = 1,    H(ψ) = (3φ − φ³)/4,  H' = δ,
//   K = h + C,  h = Δψ + √2 φ (1 − |∇ψ|²)/ε,   E = ∫ ½ β δ K² dx,   b = β K,
//
// (h rather than b is an unknown: then the forces along the membrane, e ∇c − δ ∇(½ β K²) = −δ b ∇h, are smooth at the
// patch's edge.) This is (D) with φ = tanh(ψ/(√2 ε)) put in. Its variation is g = ∇·(δ ∇b) + ½ δ' β K² − √2 b δ φ' (1 −
// |∇ψ|²)/ε. δ weighs everything that lives on the membrane (tension, molecules, stretching, the motion of ψ, the step
// of the viscosity), so that the layer's first-order effects cancel: what remains is O(ε²).

/// What is known at a point besides the iterate: Σ_j a_j y(t_j) of the past for every quantity with a time derivative,
/// and the predicted normal.
struct PointHistory {
    double indicator = 0;   // of H
    double distance = 0;    // of ψ
    double molecules = 0;   // of δ c
    double stretching = 0;  // of δ s
    double velocity_r = 0, velocity_z = 0;
    double normal_r = 0, normal_z = 0;  // ∇ψ/|∇ψ|
};

/// Numbers of one step.
struct StepNumbers {
    double rate = 0;  // a₀ [1/µs]
    PhaseFieldParameters numerics;
    FluidParameters fluid;
    MoleculeParameters molecules;
};

inline constexpr double surface_floor = 1e-8;   // [1/nm] added to δ, so that c and s are defined everywhere
inline constexpr double distance_floor = 1e-5;  // part of (1 − φ²)² that moves ψ far from the layer
inline constexpr double profile_floor =
    3e-2;  // the same for the flux that keeps |∇ψ| = 1, which ties the tails to the layer
inline constexpr double alignment_floor = 1e-4;  // the same for λ
inline constexpr double tail_diffusivity = 100;  // [nm²/µs] smooths ψ in the tails, where normals may cross
inline constexpr double gradient_floor = 1e-3;   // of |∇ψ| in the normal

/// φ, δ, δ' and the rest that only depend on ψ.
template <class Number>
struct LayerProfile {
    Number phi, delta, delta_slope, squared_well;  // φ, δ [1/nm], dδ/dψ [1/nm²], (1 − φ²)²
};

template <class Number>
LayerProfile<Number> layer_profile(const Number& psi, double epsilon) {
    const double t = std::tanh(value_of(psi) * inverse_sqrt2 / epsilon);
    const Number phi = chain(psi, t, (1 - t * t) * inverse_sqrt2 / epsilon);
    const Number well = 1.0 - phi * phi, squared = well * well;
    const Number delta = (0.75 * inverse_sqrt2 / epsilon) * squared;
    return {phi, delta, (-2 / (inverse_sqrt2 * epsilon)) * phi * delta, squared};
}

/// H(ψ) from φ: −½ … ½.
template <class Number>
Number layer_indicator(const Number& phi) {
    return 0.25 * phi * (3.0 - phi * phi);
}

/// β, C and their derivatives with respect to c as functions of c.
template <class Number>
struct Stiffness {
    Number beta, beta_c, curvature, curvature_c;
};

/// c as the laws see it: c itself on [0, 1], bent smoothly to stay within a twentieth of it outside. A sharp limit
/// would switch derivatives on and off where c is 1 but for round-off, and Newton's method would not converge.
template <class Number>
Number limited_concentration(const Number& c) {
    constexpr double margin = 0.05;
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

template <class Number>
Number inverse_root(const Number& x) {
    const double f = 1 / std::sqrt(value_of(x));
    return chain(x, f, -0.5 * f / value_of(x));
}

/// ν(ψ) [pN µs/nm²]. The arithmetic mean steps with H, so that its step matches the layer's tension.
template <class Number>
Number layer_viscosity(const Number& phi, const FluidParameters& fluid, ViscosityMean mean) {
    const double nu1 = fluid.viscosity_extracellular, nu2 = fluid.viscosity_intracellular;
    const Number outside = 0.5 + layer_indicator(phi);
    if (mean == ViscosityMean::harmonic) return 1.0 / (1 / nu2 + (1 / nu1 - 1 / nu2) * outside);
    return nu2 + (nu1 - nu2) * outside;
}

/// What the rows share.
template <class Number>
struct PointGeometry {
    LayerProfile<Number> layer;
    Number normal_r, normal_z, defect;  // n = ∇ψ/|∇ψ|; √2 (1 − |∇ψ|²)/ε [1/nm]
};

/// The bending state: K, b = β K with its gradient, the density ½ β K² and e = δ ∂(½ β K²)/∂c.
template <class Number>
struct PointBending {
    Number K, b, b_r, b_z, density, concentration_force;
};

template <class Number>
PointBending<Number> point_bending(const Fields<Number>& x, const LayerProfile<Number>& layer,
                                   const BendingModel& model) {
    const auto &h = x[curvature], &c = x[molecule_density];
    const Stiffness<Number> m = stiffness_of(c.value, model);
    const Number K = h.value + m.curvature, b = m.beta * K;
    const Number by_c = K * m.beta_c + m.beta * m.curvature_c;  // db/dc at fixed h
    const Number density = 0.5 * K * b;
    return {K,
            b,
            m.beta * h.r + by_c * c.r,
            m.beta * h.z + by_c * c.z,
            density,
            layer.delta * (0.5 * K * K * m.beta_c + b * m.curvature_c)};
}

/// Bending: h from ∫ (h − √2 φ (1 − |∇ψ|²)/ε) η + ∇ψ·∇η and g as the variation above.
template <class Number>
void add_bending(const Fields<Number>& x, const PointGeometry<Number>& p, const PointBending<Number>& bending,
                 double epsilon, Fields<Number>& row) {
    const auto& psi = x[distance];
    row[curvature] = {x[curvature].value - p.layer.phi * p.defect, psi.r, psi.z};
    const Number slope = (inverse_sqrt2 / epsilon) * (1.0 - p.layer.phi * p.layer.phi);  // dφ/dψ
    row[bending_force] = {
        x[bending_force].value - p.layer.delta_slope * bending.density - p.layer.delta * bending.b * p.defect * slope,
        p.layer.delta * bending.b_r, p.layer.delta * bending.b_z};
}

/// (32), (33): momentum with the forces g ∇ψ + e ∇c − ∇·(δ λ P), and volume. The pressure balances the layer's own
/// stress δ (½ β K² + ∇ψ·∇b) and the tension the jump −½ β K² of the energy at the patch's edge; both are taken out of
/// the unknowns, so that what is left is smooth. Otherwise the part of that gradient force which the discrete pressure
/// and tension cannot balance would drive a spurious flow through the edge.
template <class Number>
void add_flow(const Fields<Number>& x, const PointGeometry<Number>& p, const PointBending<Number>& bending, double r,
              const PointHistory& past, const StepNumbers& step, Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &psi = x[distance], &c = x[molecule_density];
    const Number &g = x[bending_force].value, &e = bending.concentration_force;
    const Number nu = layer_viscosity(p.layer.phi, step.fluid, step.numerics.viscosity_mean);
    const Number hoop = ur.value / r, divergence = ur.r + hoop + uz.z;
    const Number pressure =
        x[pressure_rest].value + p.layer.delta * (bending.density + psi.r * bending.b_r + psi.z * bending.b_z);
    const Number tension = p.layer.delta * (x[tension_rest].value - bending.density);
    const Number shear = nu * (ur.z + uz.r) - tension * p.normal_r * p.normal_z;
    row[velocity_r] = {(2.0 * nu * hoop - pressure + tension) / r - g * psi.r - e * c.r,
                       2.0 * nu * ur.r - pressure + tension * (1.0 - p.normal_r * p.normal_r), shear};
    row[velocity_z] = {-g * psi.z - e * c.z, shear,
                       2.0 * nu * uz.z - pressure + tension * (1.0 - p.normal_z * p.normal_z)};
    if (step.fluid.inertia) {
        const double rho = step.fluid.density;
        row[velocity_r].value += rho * (step.rate * ur.value + past.velocity_r + ur.value * ur.r + uz.value * ur.z);
        row[velocity_z].value += rho * (step.rate * uz.value + past.velocity_z + ur.value * uz.r + uz.value * uz.z);
    }
    row[pressure_rest].value = -divergence;
}

/// (34): P:∇u = ζ (s − 1) on the average across the layer. λ is kept constant along the normal by the alignment
/// [nm³/(pN µs)], so that the membrane is one surface and not a stack of inextensible sheets; the leak [nm³/(pN µs)]
/// only defines λ far from the layer.
template <class Number>
void add_inextensibility(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past, double r,
                         const PhaseFieldParameters& numerics, Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &lambda = x[tension_rest];
    const Number& s = x[membrane_stretch].value;
    const Number stretching =
        ur.r + ur.value / r + uz.z -
        (p.normal_r * p.normal_r * ur.r + p.normal_r * p.normal_z * (ur.z + uz.r) + p.normal_z * p.normal_z * uz.z);
    const Number along = (numerics.tension_alignment * (p.layer.squared_well + alignment_floor)) *
                         (past.normal_r * lambda.r + past.normal_z * lambda.z);
    const Number phi2 = p.layer.phi * p.layer.phi, leak = numerics.tension_leak * phi2 * phi2;
    row[tension_rest] = {p.layer.delta * (stretching - numerics.strain_relaxation * (s - 1.0)),
                         -(along * past.normal_r + leak * lambda.r), -(along * past.normal_z + leak * lambda.z)};
}

/// (35): H(ψ) moves with the fluid, δ ( ∂ψ/∂t + u·∇ψ ) = −(mobility) g, and |∇ψ| = 1 is kept by a flux along the
/// normal, M ε δ (n·∇ψ − 1) n. That flux conserves ∫H, so it does not move the membrane. Divided by max δ.
template <class Number>
void add_motion(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                const StepNumbers& step, Fields<Number>& row) {
    const auto& psi = x[distance];
    const double epsilon = step.numerics.epsilon, length = epsilon / (0.75 * inverse_sqrt2);  // 1/max δ
    const Number weight = p.layer.squared_well + distance_floor;
    const Number flux =
        (step.numerics.profile_relaxation * epsilon) * weight * (past.normal_r * psi.r + past.normal_z * psi.z - 1.0);
    Number rate = length * (step.rate * layer_indicator(p.layer.phi) + past.indicator) +
                  distance_floor * (step.rate * psi.value + past.distance) +
                  weight * (x[velocity_r].value * psi.r + x[velocity_z].value * psi.z);
    if (step.fluid.dynamics == Dynamics::geometric)
        rate += (length * step.fluid.normal_mobility) * x[bending_force].value;
    const Number phi2 = p.layer.phi * p.layer.phi;
    const Number smoothing = (tail_diffusivity * phi2 * phi2 * phi2 * phi2) * weight;
    row[distance] = {rate, flux * past.normal_r + smoothing * psi.r, flux * past.normal_z + smoothing * psi.z};
}

/// D_n ∇·(δ n n·∇y): keeps y constant along the normal, the predicted one, so that the term is linear.
template <class Number>
void add_alignment(const AtPoint<Number>& y, const PointHistory& past, const Number& diffusivity,
                   AtPoint<Number>& row) {
    const Number flux = diffusivity * (past.normal_r * y.r + past.normal_z * y.z);
    row.r += flux * past.normal_r;
    row.z += flux * past.normal_z;
}

template <class Number>
void add_diffusion(const AtPoint<Number>& y, const Number& diffusivity, AtPoint<Number>& row) {
    row.r += diffusivity * y.r;
    row.z += diffusivity * y.z;
}

/// (40), (41), or (39), or (14): δ c is conserved.
template <class Number>
void add_molecules(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                   const StepNumbers& step, Fields<Number>& row) {
    const auto &c = x[molecule_density], &mu = x[molecule_potential];
    const Number surface = p.layer.delta + surface_floor, density = surface * c.value;
    row[molecule_density] = {step.rate * density + past.molecules, -(density * x[velocity_r].value),
                             -(density * x[velocity_z].value)};
    add_alignment(c, past, step.molecules.normal_diffusivity * surface, row[molecule_density]);
    row[molecule_potential].value = surface * mu.value;
    if (step.molecules.transport == Transport::cahn_hilliard) {
        const double width = step.molecules.interface_width;
        const auto well = double_well(value_of(c.value));
        add_diffusion(mu, step.molecules.mobility * surface, row[molecule_density]);
        row[molecule_potential].value = surface * (mu.value - chain(c.value, well.first, well.second) / width);
        add_diffusion(c, -width * surface, row[molecule_potential]);
    } else if (step.molecules.transport == Transport::fickian) {
        add_diffusion(c, step.molecules.diffusivity * surface, row[molecule_density]);
    }
}

/// (38): δ s is the membrane's material; where it enters at the rim s = 1.
template <class Number>
void add_stretching(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past, double r,
                    const StepNumbers& step, Fields<Number>& row) {
    const auto &s = x[membrane_stretch], &ur = x[velocity_r], &uz = x[velocity_z], &psi = x[distance];
    const Number surface = p.layer.delta + surface_floor, density = surface * s.value;
    row[membrane_stretch].value = step.rate * density + past.stretching + density * (ur.r + ur.value / r + uz.z) +
                                  surface * (ur.value * s.r + uz.value * s.z) +
                                  p.layer.delta_slope * s.value * (ur.value * psi.r + uz.value * psi.z);
    add_alignment(s, past, step.numerics.stretching_alignment * surface, row[membrane_stretch]);
    add_diffusion(s, step.numerics.stretching_diffusivity * surface, row[membrane_stretch]);
}

/// All rows at one point at radius r [nm].
template <class Number>
Fields<Number> point_equations(const Fields<Number>& x, double r, const PointHistory& past, const StepNumbers& step,
                               const BendingModel& model) {
    const double epsilon = step.numerics.epsilon;
    const auto& psi = x[distance];
    const Number squared = psi.r * psi.r + psi.z * psi.z;
    const Number inverse = inverse_root(squared + gradient_floor * gradient_floor);
    const PointGeometry<Number> p{layer_profile(psi.value, epsilon), psi.r * inverse, psi.z * inverse,
                                  (1 / (inverse_sqrt2 * epsilon)) * (1.0 - squared)};
    const PointBending<Number> bending = point_bending(x, p.layer, model);
    Fields<Number> row;
    add_bending(x, p, bending, epsilon, row);
    add_flow(x, p, bending, r, past, step, row);
    add_inextensibility(x, p, past, r, step.numerics, row);
    add_motion(x, p, past, step, row);
    add_molecules(x, p, past, step, row);
    add_stretching(x, p, past, r, step, row);
    return row;
}

}  // namespace endoflow::phasefield::production
