#pragma once

#include "phasefield/schemes/production/bending_equation.h"
#include "phasefield/schemes/production/normal_diffusion.h"

namespace endoflow::phasefield::production {

/// The force on the fluid per volume [pN/nm³], the right side of (32) without λ:
///
///   δ_N (G − Δp) ∇ψ + δ_Γ (e_c ∇ₜc + f + F_a c/∫c dA e_z) + δ_E e_c ∇ₙc + E_ε ∇ₙε + D δ ∂_N G ∂_N∇ψ.
///
/// Along the sheets e_c ∇c has the weight of the tension that balances it; where c's level lines are off the normal,
/// the part across is that of the energy, or the two would not cancel in the net force, 1 pN of which is a per cent of
/// the flow. Of the loads, the pressure Δp acts as the normal force −Δp of the fluid that it is taken off of: p is less
/// than the pressure by Δp (½ + ∫ δ_N dψ), so that walls are free of stress. The last term gives back what the
/// diffusion of G along the normal takes from the net force where ∇ψ changes along the normal, with ψ's own normal:
/// that of an extrapolated ψ, whose tails the layer has reached after a step of ε, would leave some pN. Its work is
/// nobody's loss: where layers meet and ψ is no distance it would pump, so it fades there.
template <class Number>
PlaneVector<Number> membrane_force(const Fields<Number>& x, const PointGeometry<Number>& p,
                                   const MembraneForces<Number>& force, const PointPast& past,
                                   const GradientChange<Number>& change, const StepNumbers& step) {
    const auto &psi = x[distance], &c = x[molecule_density], &G = x[normal_force];
    const Number normal = p.delta_N * (G.value - step.loads.pressure);
    // e_c along the sheets is cut off where δ_E is.
    const Number molecules = step.weight.cut * kept_by_cut(p.layer.well, tail_cut) * p.delta_Gamma * force.e_c;
    const Number across = force.thickness + (p.delta_E * force.e_c - molecules) * dot(psi, c) /
                                                (p.squared_gradient + gradient_floor * gradient_floor);
    const Number uneven =
        evenness(change, p.epsilon) * diffusivity<diffusion_of(normal_force)>(p, past, step) * dot(p.own_normal, G);
    const Number squeezed = past.material_force.r * p.delta_Gamma,
                 pulled = (past.material_force.z + step.coat_force * c.value) * p.delta_Gamma;
    return {(normal + across) * psi.r + molecules * c.r + uneven * change.r + squeezed,
            (normal + across) * psi.z + molecules * c.z + uneven * change.z + pulled};
}

/// (32), (33): momentum and volume,
///
///   ρ (∂_t u + u·∇u) − ∇·ν (∇u + ∇uᵀ) + ∇(p + δ p_Γ − γ ν ∇·u) = force + ∇·(δ_Γ λ P),   ∇·u = 0,
///
/// of which ∇·(…) stands in the rows as the stress times the test function's gradient. The pressure in the layer is
/// p + δ p_Γ, p_Γ constant along the normal the multiplier of ∫ δ ∇·u across the layer: p alone, continuous and
/// quadratic, cannot follow δ on cells as wide as the layer, and the rest would drive a spurious flow. So does what the
/// space of p leaves of a pressure within cells, for ∇·u vanishes only against p's functions. The penalty γ, zero for
/// the solution, holds that back (Olshanskii and Reusken, Math. Comp. 73, 1699 (2004)); but what is left to the
/// velocity on coarse cells then is stiffer, so γ goes with the pressures over the flow, which is the membrane's speed.
template <class Number>
void add_flow(const Fields<Number>& x, const PointGeometry<Number>& p, const MembraneForces<Number>& of_membrane,
              double r, const PointPast& past, const GradientChange<Number>& change, const StepNumbers& step,
              Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z], &p_Gamma = x[pressure_layer];
    const auto& [N_r, N_z] = p.N_epsilon;
    const Number nu = layer_viscosity(p.layer.phi, step.fluid, step.weight, step.numerics.viscosity_mean);
    const Number hoop = ur.value / r, divergence = ur.r + hoop + uz.z;
    const Number isotropic =
        x[pressure].value + p.layer.delta * p_Gamma.value - step.divergence_penalty * nu * divergence;
    const Number lambda = p.delta_Gamma * x[tension].value;
    const Number shear = nu * (ur.z + uz.r) - lambda * N_r * N_z;
    const PlaneVector<Number> force = membrane_force(x, p, of_membrane, past, change, step);
    row[velocity_r] = {(2.0 * nu * hoop - isotropic + lambda) / r - force.r,
                       2.0 * nu * ur.r - isotropic + lambda * (1.0 - N_r * N_r), shear};
    row[velocity_z] = {-force.z, shear, 2.0 * nu * uz.z - isotropic + lambda * (1.0 - N_z * N_z)};
    if (step.fluid.inertia) {
        const double rho = step.fluid.density;
        row[velocity_r].value += rho * (step.rate * ur.value + past.velocity_r + ur.value * ur.r + uz.value * ur.z);
        row[velocity_z].value += rho * (step.rate * uz.value + past.velocity_z + ur.value * uz.r + uz.value * uz.z);
    }
    row[pressure].value = -divergence;
    row[pressure_layer].value = -p.layer.delta * (divergence + step.rates.pressure_leak * p_Gamma.value);
}

/// (34): δ_Γ (P:∇u − ζ (s − 1)), on the average across the layer because λ is constant along the normal.
template <class Number>
void add_inextensibility(const Fields<Number>& x, const PointGeometry<Number>& p, double r, const StepNumbers& step,
                         Fields<Number>& row) {
    const auto &ur = x[velocity_r], &uz = x[velocity_z];
    const Number& s = x[membrane_stretch].value;
    const Number stretching =
        surface_divergence<Number>(p.N_epsilon.r, p.N_epsilon.z, ur.r, ur.value / r, uz.z, ur.z + uz.r);
    row[tension].value = p.delta_Gamma * (stretching - step.rates.strain_relaxation * (s - 1.0));
}

}  // namespace endoflow::phasefield::production
