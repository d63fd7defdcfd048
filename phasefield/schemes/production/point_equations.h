#pragma once

#include <algorithm>
#include <cmath>

#include "phasefield/layer/profile.h"
#include "phasefield/schemes/production/dual.h"
#include "phasefield/schemes/production/fields.h"
#include "phasefield/schemes/production/layer_weights.h"
#include "phasefield/schemes/production/membrane_weight.h"
#include "shared/model/bending_model.h"
#include "shared/model/double_well.h"

namespace endoflow::phasefield::production {

// The weak form of the production scheme at one point, written once: with plain numbers it is the residual, with duals
// its exact Jacobian. The unknown is ψ with φ = tanh(ψ/(√2 ε)), so that all fields are smooth across the layer.
//
//   δ(ψ) = 3 (1 − φ²)²/(4√2 ε),  ∫δ dψ = 1,    H(ψ) = (3φ − φ³)/4,  H' = δ,
//   K = h + C,  h = Δψ + √2 φ (1 − |∇ψ|²)/ε,   E = ∫ ½ β δ K² dx,   b = β K.
//
// This is (D) with φ = tanh(ψ/(√2 ε)) put in. One weight δ_m (membrane_weight.h) weighs everything that lives on the
// membrane (tension, molecules, stretching, the motion of ψ, the step of the viscosity), so that the layer's
// first-order effects cancel: what remains is O(ε²). The force on the fluid is δ_m (G ∇ψ + e ∇c), where δ_m G is the
// variation of the discrete energy with respect to ψ, and ψ and c move with the same weight: then the work of the force
// is exactly the energy's change. Without that, motions at the scale of the cells gain energy and grow.

/// A unit vector; shorter where normals cross.
struct Direction {
    double r = 0, z = 0;
};

/// What is known at a point besides the iterate: Σ_j a_j y(t_j) of the past for every quantity with a time derivative,
/// and of the predicted ψ the normal, at which alignment aims.
struct PointHistory {
    double distance = 0;    // of ψ
    double indicator = 0;   // of ∫ δ_m dψ
    double molecules = 0;   // of δ_m c
    double stretching = 0;  // of δ_m s
    double velocity_r = 0, velocity_z = 0;
    Direction normal;                 // n = ∇ψ/|∇ψ|; far from the membrane that of its closest point
    Direction molecules_normal;       // the same with the error of BDF, for c
    double slope_r = 0, slope_z = 0;  // ∇Σ_j a_j ψ(t_j)
};

/// n·∇∇ψ [1/nm] with the predicted n: how ∇ψ changes along the normal, 0 where ψ is a distance. The Jacobian holds it
/// fixed.
struct GradientChange {
    double r = 0, z = 0;
};

/// Numbers of one step.
struct StepNumbers {
    double rate = 0;  // a₀ [1/µs]
    PhaseFieldParameters numerics;
    FluidParameters fluid;
    MoleculeParameters molecules;
    MembraneWeight weight;
    double profile_relaxation = numerics.production.profile_relaxation;  // M of this step [nm/µs]
};

inline constexpr double surface_floor = 1e-8;    // [1/nm] added to δ, so that G, μ and s are defined everywhere
inline constexpr double moment_floor = 4e-5;     // [nm] continues b smoothly where the energy has no weight
inline constexpr double force_alignment = 20;    // [ε²] keeps G constant along the normal
inline constexpr double moment_alignment = 20;   // [ε²] the same for b
inline constexpr double step_alignment = 20;     // [ε² per step] the same for c and s, and of ∂ψ/∂t
inline constexpr double alignment_floor = 1e-4;  // [of (1 − φ²)²] the same for λ and q
inline constexpr double far_part = 1e-7;         // of M, with which ψ becomes the distance far from the layer
inline constexpr double layer_pressure_alignment = 30;     // [nm³/(pN µs)] keeps q constant along the normal
inline constexpr double pressure_leak = 0.01;              // [nm/(pN µs)] ∇·u per q: decides between p and δ q
inline constexpr double least_normal_diffusivity = 1.1e5;  // [nm⁵/µs/ε³] of c: 6.4e4 nm²/µs at ε = 1.2 nm
inline constexpr double molecule_leak = 1e-3;              // [nm/µs] defines c far from the layer
inline constexpr double gradient_floor = 1e-3;             // of |∇ψ| in the normal
inline constexpr double uneven_fade = 20;  // [1/ε] of ∂ₙ∇ψ, beyond which the force that balances G's diffusion fades

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

/// ∂/∂c of the energy per area, ½ β K² with K = h + C, at a given shape [pN/nm].
template <class Number>
Number molecular_energy(const Number& b, const Number& K, const Stiffness<Number>& m) {
    return b * m.curvature_c + 0.5 * K * K * m.beta_c;
}

template <class Number>
Number inverse_root(const Number& x) {
    const double f = 1 / std::sqrt(value_of(x));
    return chain(x, f, -0.5 * f / value_of(x));
}

/// What the rows share.
template <class Number>
struct PointGeometry {
    LayerProfile<Number> layer;
    Number surface, density;                                        // δ with a floor, δ_m [1/nm]
    Number indicator;                                               // ∫ δ_m dψ
    Number normal_r, normal_z, squared_gradient, inverse_gradient;  // n = ∇ψ/|∇ψ|; |∇ψ|²; 1/|∇ψ|
};

/// The part of g along the normal, (n n + (1 − |n|²))·g: all of it where normals cross and n vanishes.
template <class Number>
Number normal_part(const Direction& n, double n_own, const Number& own, double n_other, const Number& other) {
    return (1 - n.r * n.r - n.z * n.z + n_own * n_own) * own + (n_own * n_other) * other;
}

/// D_n ∇·(δ n n·∇y): keeps y constant along the normal, a predicted one, so that the term is linear.
template <class Number>
void add_alignment(const AtPoint<Number>& y, const Direction& n, const Number& diffusivity, AtPoint<Number>& row) {
    row.r += diffusivity * normal_part(n, n.r, y.r, n.z, y.z);
    row.z += diffusivity * normal_part(n, n.z, y.z, n.r, y.r);
}

/// D of G [nm²] times δ.
template <class Number>
Number force_diffusivity(const PointGeometry<Number>& p, double epsilon) {
    return (force_alignment * epsilon * epsilon) * p.surface;
}

/// The bending energy as a functional of ψ, the moment b and c whose stationary value over b is E:
///
///   E = ∫ w b h + w (b C − b²/(2 β)) − ½ D w (∇ψ·∇b)² dx,   h = Δψ − w' (1 − |∇ψ|²)/(2w),   w the weight above,
///
/// the Laplacian of ψ integrated by parts. With w = δ this h is the one at the top of this page; with another h a
/// weight that is cut off exerts a force on curved membranes, one that does not vanish with ε. The last term keeps b
/// constant along the normal: a sharp membrane has one curvature, not one for each level set. Its derivatives with
/// respect to b, ψ and c are the rows of b and of the normal force G and the force e ∇c, so that the discrete equations
/// obey the energy law. G is kept constant along the normal: what varies there is the force that keeps the profile,
/// which the profile's relaxation takes over. Acting on the fluid it would drive a flow within the layer that the
/// relaxation undoes all the time. Returns e [pN/nm], cut off in the tails, too.
template <class Number>
Number add_bending(const Fields<Number>& x, const PointGeometry<Number>& p, const BendingModel& model, double epsilon,
                   const PointHistory& past, Fields<Number>& row) {
    const auto &psi = x[distance], &b = x[moment];
    const Stiffness<Number> m = stiffness_of(x[molecule_density].value, model);
    const EnergyWeight<Number> w = energy_weight(p.layer, epsilon);
    const Number K = b.value / m.beta, density = 0.5 * K * b.value, mean = 0.5 * (1.0 + p.squared_gradient);
    const double smoothing = moment_floor / model.stiffness(0).value;
    row[moment] = {w.value * (K - m.curvature) + w.first * mean, w.value * psi.r + smoothing * b.r,
                   w.value * psi.z + smoothing * b.z};
    const Number twist = w.first * b.value;
    row[normal_force] = {(p.density + surface_floor) * x[normal_force].value +
                             w.first * (psi.r * b.r + psi.z * b.z - m.curvature * b.value + density) +
                             w.second * mean * b.value,
                         w.value * b.r + twist * psi.r, w.value * b.z + twist * psi.z};
    add_alignment(x[normal_force], past.normal, force_diffusivity(p, epsilon), row[normal_force]);
    const double compliance = moment_alignment * epsilon * epsilon / model.stiffness(0).value;
    const Number slope = psi.r * b.r + psi.z * b.z, flux = compliance * w.value * slope;
    row[moment].r += flux * psi.r;
    row[moment].z += flux * psi.z;
    row[normal_force].value += (0.5 * compliance) * w.first * slope * slope;
    row[normal_force].r += flux * b.r;
    row[normal_force].z += flux * b.z;
    return w.kept * molecular_energy(b.value, K, m);
}

template <class Number>
void add_diffusion(const AtPoint<Number>& y, const Number& diffusivity, AtPoint<Number>& row) {
    row.r += diffusivity * y.r;
    row.z += diffusivity * y.z;
}

/// Multipliers of conditions on the membrane are constant along the normal, and smooth far from the layer.
template <class Number>
void extend_multiplier(const AtPoint<Number>& y, const PointGeometry<Number>& p, const PointHistory& past,
                       double alignment, double leak, AtPoint<Number>& row) {
    const Number phi2 = p.layer.phi * p.layer.phi;
    add_alignment(y, past.normal, -alignment * (p.layer.squared_well + alignment_floor), row);
    add_diffusion(y, -leak * (phi2 * phi2), row);
}

/// (32), (33): momentum with the forces δ_m (G ∇ψ + e ∇c) − ∇·(δ_m λ P), and volume. The diffusion of G along the
/// normal would leave a net force on the membrane where ∇ψ changes along it, D δ ∂ₙG ∂ₙ∇ψ, which is added. With ∂ₙ∇ψ of
/// an extrapolated ψ, whose tails the layer has reached after a step of ε, some pN would remain. The force's work is
/// nobody's loss: where layers meet and ψ is no distance it would pump, so it fades there. The pressure in the layer is
/// p + δ q, q constant along the normal the multiplier of ∫δ ∇·u across the layer: p alone, continuous and quadratic,
/// cannot follow δ on cells as wide as the layer, and the rest would drive a spurious flow.
template <class Number>
void add_flow(const Fields<Number>& x, const PointGeometry<Number>& p, const Number& e, double r,
              const PointHistory& past, const GradientChange& change, const StepNumbers& step, Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &psi = x[distance], &c = x[molecule_density];
    const auto& G = x[normal_force];
    const Number g = p.density * G.value, molecular = step.weight.cut * p.density * e;
    const double kink = uneven_fade * step.numerics.epsilon * std::hypot(change.r, change.z);
    const Number uneven = (1 / (1 + kink * kink)) * force_diffusivity(p, step.numerics.epsilon) *
                          (past.normal.r * G.r + past.normal.z * G.z);
    const Number nu = layer_viscosity(p.layer.phi, step.fluid, step.weight, step.numerics.viscosity_mean);
    const Number hoop = ur.value / r, divergence = ur.r + hoop + uz.z;
    const Number isotropic = x[pressure].value + p.layer.delta * x[pressure_layer].value;
    const Number stretch = p.density * x[tension].value;
    const Number shear = nu * (ur.z + uz.r) - stretch * p.normal_r * p.normal_z;
    row[velocity_r] = {(2.0 * nu * hoop - isotropic + stretch) / r - g * psi.r - molecular * c.r - uneven * change.r,
                       2.0 * nu * ur.r - isotropic + stretch * (1.0 - p.normal_r * p.normal_r), shear};
    row[velocity_z] = {-g * psi.z - molecular * c.z - uneven * change.z, shear,
                       2.0 * nu * uz.z - isotropic + stretch * (1.0 - p.normal_z * p.normal_z)};
    if (step.fluid.inertia) {
        const double rho = step.fluid.density;
        row[velocity_r].value += rho * (step.rate * ur.value + past.velocity_r + ur.value * ur.r + uz.value * ur.z);
        row[velocity_z].value += rho * (step.rate * uz.value + past.velocity_z + ur.value * uz.r + uz.value * uz.z);
    }
    row[pressure].value = -divergence;
    const auto& q = x[pressure_layer];
    row[pressure_layer].value = -p.layer.delta * (divergence + pressure_leak * q.value);
    extend_multiplier(q, p, past, layer_pressure_alignment, step.numerics.production.tension_leak, row[pressure_layer]);
}

/// (34): P:∇u = ζ (s − 1) on the average across the layer. λ is kept constant along the normal by the alignment
/// [nm³/(pN µs)], so that the membrane is one surface and not a stack of inextensible sheets; the leak [nm³/(pN µs)]
/// only defines λ far from the layer.
template <class Number>
void add_inextensibility(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past, double r,
                         const StepNumbers& step, Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &lambda = x[tension];
    const Number& s = x[membrane_stretch].value;
    const Number stretching = surface_divergence<Number>(p.normal_r, p.normal_z, ur.r, ur.value / r, uz.z, ur.z + uz.r);
    row[tension].value = p.density * (stretching - step.numerics.production.strain_relaxation * (s - 1.0));
    extend_multiplier(lambda, p, past, step.numerics.production.tension_alignment,
                      step.numerics.production.tension_leak, row[tension]);
}

/// A diffusivity along the normal [nm²/µs] made fast within a step: δ_m is negative in the layer's tails, where without
/// it y would grow.
inline double within_a_step(double diffusivity, const StepNumbers& step) {
    return diffusivity + step_alignment * step.numerics.epsilon * step.numerics.epsilon * step.rate;
}

/// (35): δ_m ( ∂ψ/∂t + u·∇ψ ) = −(mobility) δ_m G. |∇ψ| = 1 is kept by fluxes along the normal. They conserve ∫H, so
/// they do not move the membrane. 20 ε² δ n·∇(∂ψ/∂t) vanishes for distance functions however they move and outweighs
/// δ_m where that is negative; M ε δ (n·∇ψ − 1) restores what is lost. Far from the layer ψ solves ∇·(∇ψ − n) = 0,
/// whose solution is the distance, for n are the normals of the curve φ = 0 there. Divided by max δ.
template <class Number>
void add_motion(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                const StepNumbers& step, Fields<Number>& row) {
    const auto& psi = x[distance];
    const auto& n = past.normal;
    const double epsilon = step.numerics.epsilon, length = epsilon / (0.75 * inverse_sqrt2);  // 1/max δ
    const Number weight = length * p.density;
    Number rate =
        weight * (step.rate * psi.value + past.distance + x[velocity_r].value * psi.r + x[velocity_z].value * psi.z);
    if (step.fluid.dynamics == Dynamics::geometric) rate += step.fluid.normal_mobility * weight * x[normal_force].value;

    const Number changing_r = step.rate * psi.r + past.slope_r, changing_z = step.rate * psi.z + past.slope_z;
    const Number aligning = (step_alignment * epsilon * epsilon) * p.layer.squared_well;
    const double far = step.numerics.production.profile_relaxation * epsilon * far_part;
    const Number flux = (step.profile_relaxation * epsilon) * p.layer.squared_well * (n.r * psi.r + n.z * psi.z - 1.0);
    row[distance] = {rate,
                     aligning * normal_part(n, n.r, changing_r, n.z, changing_z) + (flux - far) * n.r + far * psi.r,
                     aligning * normal_part(n, n.z, changing_z, n.r, changing_r) + (flux - far) * n.z + far * psi.z};
}

/// ∂(δ_m y)/∂t + ∇·(δ_m y v), v the fluid's velocity along the membrane and the level sets' own velocity across it. The
/// two differ where the profile is being restored; with the fluid's velocity alone y would grow in the layer's tails.
/// Across, δ_m v is −(∂H/∂t) n/|∇ψ| with H = ∫ δ_m dψ, for with BDF's ∂H/∂t a plane membrane keeps a constant y however
/// far it moves in a step; δ_m ∂ψ/∂t instead leaves an error of the order of (motion/ε)³.
template <class Number>
void add_transport(const Number& y, const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                   double weighted_past, const StepNumbers& step, AtPoint<Number>& row) {
    const auto &ur = x[velocity_r].value, &uz = x[velocity_z].value;
    const Number density = p.density * y;
    const Number crossing = step.rate * p.indicator + past.indicator;
    const Number across = density * (p.normal_r * ur + p.normal_z * uz) + y * crossing * p.inverse_gradient;
    row.value = step.rate * density + weighted_past;
    row.r = across * p.normal_r - density * ur;
    row.z = across * p.normal_z - density * uz;
}

/// D_n of c [nm²/µs], larger the thinner the layer. The shear within the layer tilts c's level lines off the normal, by
/// shear rate × ε²/D_n, and the force e ∇c with them: with a constant D_n the volume's error grew as ε fell, and so it
/// did with normals that lagged behind in the layer's tails by as little as a tenth of a step.
inline double normal_diffusivity_of_molecules(const StepNumbers& step) {
    const double epsilon = step.numerics.epsilon, least = least_normal_diffusivity / (epsilon * epsilon * epsilon);
    return within_a_step(std::max(step.molecules.normal_diffusivity, least), step);
}

/// (40), (41), or (39), or (14): δ_m c is conserved. The diffusion along the membrane ends where δ_m does: on the
/// coarse cells beyond, the double well would have several solutions where the layers of bud and plane meet.
template <class Number>
void add_molecules(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                   const StepNumbers& step, Fields<Number>& row) {
    const auto &c = x[molecule_density], &mu = x[molecule_potential];
    add_transport(c.value, x, p, past, past.molecules, step, row[molecule_density]);
    const Number phi2 = p.layer.phi * p.layer.phi, weight = cut_density(p.layer);
    add_alignment(c, past.molecules_normal, normal_diffusivity_of_molecules(step) * p.surface, row[molecule_density]);
    add_diffusion(c, molecule_leak * (phi2 * phi2), row[molecule_density]);
    row[molecule_potential].value = p.surface * mu.value;
    if (step.molecules.transport == Transport::cahn_hilliard) {
        const double width = step.molecules.interface_width;
        const auto well = double_well(value_of(c.value));
        add_diffusion(mu, step.molecules.mobility * weight, row[molecule_density]);
        row[molecule_potential].value =
            p.surface * mu.value - (1 / width) * p.layer.delta * chain(c.value, well.first, well.second);
        add_diffusion(c, -width * p.layer.delta, row[molecule_potential]);
    } else if (step.molecules.transport == Transport::fickian) {
        add_diffusion(c, step.molecules.diffusivity * weight, row[molecule_density]);
    }
}

/// (38): δ_m s is the membrane's material; where it enters at the rim s = 1. The tension holds P:∇u to the average over
/// a cell; what that leaves within one, most of it at the axis, diffuses as fast as ζ relaxes s.
template <class Number>
void add_stretching(const Fields<Number>& x, const PointGeometry<Number>& p, const PointHistory& past,
                    const StepNumbers& step, Fields<Number>& row) {
    const auto& s = x[membrane_stretch];
    add_transport(s.value, x, p, past, past.stretching, step, row[membrane_stretch]);
    add_alignment(s, past.normal, within_a_step(step.numerics.production.stretching_alignment, step) * p.surface,
                  row[membrane_stretch]);
    const double smoothing =
        step.numerics.production.strain_relaxation * step.numerics.cell_size * step.numerics.cell_size;
    add_diffusion(s, (step.numerics.stretching_diffusivity + smoothing) * p.surface, row[membrane_stretch]);
}

/// All rows at one point at radius r [nm].
template <class Number>
Fields<Number> point_equations(const Fields<Number>& x, double r, const PointHistory& past,
                               const GradientChange& change, const StepNumbers& step, const BendingModel& model) {
    const double epsilon = step.numerics.epsilon;
    const auto& psi = x[distance];
    const Number squared = psi.r * psi.r + psi.z * psi.z;
    const Number inverse = inverse_root(squared + gradient_floor * gradient_floor);
    const auto layer = layer_profile(psi.value, epsilon);
    const Number density = membrane_density(layer, step.weight);
    const PointGeometry<Number> p{
        layer,           layer.delta + surface_floor,
        density,         chain(psi.value, cut_indicator(value_of(layer.phi), step.weight), value_of(density)),
        psi.r * inverse, psi.z * inverse,
        squared,         inverse};
    Fields<Number> row;
    const Number e = add_bending(x, p, model, epsilon, past, row);
    add_flow(x, p, e, r, past, change, step, row);
    add_inextensibility(x, p, past, r, step, row);
    add_motion(x, p, past, step, row);
    add_molecules(x, p, past, step, row);
    add_stretching(x, p, past, step, row);
    return row;
}

}  // namespace endoflow::phasefield::production
