#pragma once

#include <cmath>

#include "phasefield/schemes/production/bending_equation.h"

namespace endoflow::phasefield::production {

/// (32), (33): momentum with the forces δ_m (G ∇ψ + e (∇c − n n·∇c)) + w e n n·∇c + E_ε n n·∇ε − ∇·(δ_m λ P), and
/// volume. Along the sheets e ∇c and the tension it is balanced by have one weight; where c's level lines are off the
/// normal, the part across is that of the energy, w, or the two would not cancel in the net force, 1 pN of which is a
/// per cent of the flow. Of the loads, the pressure Δp acts as the normal force −Δp of the fluid that it is taken off
/// of: p is less than the pressure by Δp (½ + H_m), so that walls are free of stress. The pole force is one of the
/// forces, the rim's tension acts at the boundary. The diffusion of G along the normal would leave a net force on the
/// membrane where ∇ψ changes along it, D δ ∂ₙG ∂ₙ∇ψ, which is added. With ∂ₙ∇ψ of an extrapolated ψ, whose tails the
/// layer has reached after a step of ε, some pN would remain. The force's work is nobody's loss: where layers meet and
/// ψ is no distance it would pump, so it fades there. The pressure in the layer is p + δ q, q constant along the normal
/// the multiplier of ∫δ ∇·u across the layer: p alone, continuous and quadratic, cannot follow δ on cells as wide as
/// the layer, and the rest would drive a spurious flow. So does what the space of p leaves of a pressure within cells,
/// for ∇·u vanishes only against p's functions. A penalty of ∇·u, zero for the solution, holds that back (Olshanskii
/// and Reusken, Math. Comp. 73, 1699 (2004)); but what is left to the velocity on coarse cells then is stiffer, so the
/// penalty goes with the pressures over the flow, which is the membrane's speed.
template <class Number>
void add_flow(const Fields<Number>& x, const PointGeometry<Number>& p, const BendingForces<Number>& force, double r,
              const PointPast& past, const GradientChange<Number>& change, const StepNumbers& step,
              Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &psi = x[distance], &c = x[molecule_density];
    const auto& G = x[normal_force];
    const Number g = p.density * (G.value - step.loads.pressure), molecular = step.weight.cut * p.density * force.along;
    const Number across = force.of_thickness + (force.across - molecular) * (psi.r * c.r + psi.z * c.z) /
                                                   (p.squared_gradient + gradient_floor * gradient_floor);
    const DirectionOf<Number> n = own_normal(psi, past);
    const Number uneven = evenness(change, p.epsilon) * force_diffusivity(p) * (n.r * G.r + n.z * G.z);
    const Number nu = layer_viscosity(p.layer.phi, step.fluid, step.weight, step.numerics.viscosity_mean);
    const Number hoop = ur.value / r, divergence = ur.r + hoop + uz.z;
    const Number isotropic =
        x[pressure].value + p.layer.delta * x[pressure_layer].value - step.divergence_penalty * nu * divergence;
    const Number stretch = p.density * x[tension].value;
    const Number shear = nu * (ur.z + uz.r) - stretch * p.normal_r * p.normal_z;
    row[velocity_r] = {
        (2.0 * nu * hoop - isotropic + stretch) / r - g * psi.r - molecular * c.r - across * psi.r - uneven * change.r,
        2.0 * nu * ur.r - isotropic + stretch * (1.0 - p.normal_r * p.normal_r), shear};
    row[velocity_z] = {-g * psi.z - molecular * c.z - across * psi.z - uneven * change.z - past.pole_force * p.density,
                       shear, 2.0 * nu * uz.z - isotropic + stretch * (1.0 - p.normal_z * p.normal_z)};
    if (step.fluid.inertia) {
        const double rho = step.fluid.density;
        row[velocity_r].value += rho * (step.rate * ur.value + past.velocity_r + ur.value * ur.r + uz.value * ur.z);
        row[velocity_z].value += rho * (step.rate * uz.value + past.velocity_z + ur.value * uz.r + uz.value * uz.z);
    }
    row[pressure].value = -divergence;
    const auto& q = x[pressure_layer];
    row[pressure_layer].value = -p.layer.delta * (divergence + step.rates.pressure_leak * q.value);
    extend_multiplier(q, p, past, step.rates.layer_pressure_alignment, step.rates.tension_leak, row[pressure_layer]);
}

/// (34): P:∇u = ζ (s − 1) on the average across the layer. λ is kept constant along the normal by the alignment,
/// so that the membrane is one surface and not a stack of inextensible sheets; the leak only defines λ far from the
/// layer.
template <class Number>
void add_inextensibility(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past, double r,
                         const StepNumbers& step, Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &lambda = x[tension];
    const Number& s = x[membrane_stretch].value;
    const Number stretching = surface_divergence<Number>(p.normal_r, p.normal_z, ur.r, ur.value / r, uz.z, ur.z + uz.r);
    row[tension].value = p.density * (stretching - step.rates.strain_relaxation * (s - 1.0));
    extend_multiplier(lambda, p, past, step.rates.tension_alignment, step.rates.tension_leak, row[tension]);
}

}  // namespace endoflow::phasefield::production
