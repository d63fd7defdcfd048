#pragma once

#include <algorithm>

#include "phasefield/schemes/production/bending_equation.h"
#include "phasefield/schemes/production/step_numbers.h"

namespace endoflow::phasefield::production {

inline constexpr double crowding_length = constant("crowding_length");

/// ∂_t(δ_Γ y) + ∇·(δ_Γ y v), v the fluid's velocity along the membrane and the level sets' own velocity across it. The
/// two differ where the profile is being restored; with the fluid's velocity alone y would grow in the layer's tails.
/// Across, δ_Γ v is −(∂_t H_Γ) N_ε/|g|, for with BDF's ∂_t H_Γ a plane membrane keeps a constant y however far it moves
/// in a step; δ_Γ ∂_tψ instead leaves an error of the order of (motion/ε)³.
template <class Number>
void add_transport(const Number& y, const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                   double weighted_past, const StepNumbers& step, AtPoint<Number>& row) {
    const auto& N = p.N_epsilon;
    const PlaneVector<Number> u{x[velocity_r].value, x[velocity_z].value};
    const Number density = p.delta_Gamma * y;
    const Number crossing = step.rate * p.H_Gamma + past.indicator;
    const Number across = density * dot(N, u) + y * crossing * p.inverse_g;
    row.value = step.rate * density + weighted_past;
    row.r = across * N.r - density * u.r;
    row.z = across * N.z - density * u.z;
}

/// −∇·(D t t·∇y) along the sheets: across them δ may change where the layer thins, and y would follow. Diffusion over
/// the membrane is that over its sheets where D has the sheets' metric a in it: on them a length along the meridian is
/// 1 + κ₁ψ times as long, the gradient as much smaller, and ∫ δ (1 + κ₂ψ)/(1 + κ₁ψ) dψ is 1 + 0.645 (κ₁ε)²: 2 % at the
/// edge of a coat, where a membrane bends most.
template <class Number>
void add_surface_diffusion(const AtPoint<Number>& y, const Number& diffusivity, const PointGeometry<Number>& p,
                           AtPoint<Number>& row) {
    const Number flux = diffusivity * along_sheet(y, p.N_epsilon);
    add_flux<Number>({-1.0 * flux * p.N_epsilon.z, flux * p.N_epsilon.r}, row);
}

/// D_s. What the tension leaves of P:∇u within a cell diffuses away in s, as fast as ζ relaxes s over a cell, and as
/// fast as crowded molecules would crowd the membrane further [nm²/µs].
inline double stretch_diffusivity(const StepNumbers& step) {
    const double h = step.numerics.cell_size;
    return step.numerics.stretching_diffusivity +
           std::max(step.rates.strain_relaxation * h * h, crowding_length * h * step.rates.crowding);
}

/// (40), (41), or (39), or (14): δ_Γ c is conserved under the case's transport law, whose flux is −M ∇μ. The potential
/// is a field of its own where it holds ∇_Γ c; that of a coupled energy is add_bending's. The diffusion along the
/// membrane ends where δ_Γ does: on the coarse cells beyond, the double well would have several solutions where the
/// layers of bud and plane meet. The molecules ride on the membrane that the diffusion of s moves along itself: where
/// P:∇u crowds the membrane within a cell it crowds c, too, and the force e_c ∇c crowds both further, at a rate of e_c
/// c k/(ν₁ + ν₂) for wave numbers k that the tension does not reach. Diffusion of c would hold that back, too, but
/// spread the coat. A membrane that may stretch keeps its s, and its molecules stay.
template <class Number>
void add_molecules(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                   const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    const auto &c = x[molecule_density], &mu = x[molecule_potential], &s = x[membrane_stretch];
    add_transport(c.value, x, p, past, past.molecules, step, row[molecule_density]);
    const Number delta = cut_delta(p.layer);
    if (step.inextensible)
        add_surface_diffusion(s, stretch_diffusivity(step) * delta * c.value, p, row[molecule_density]);
    const TransportLaw& law = step.transport;
    const double M = law.mobility, a = energy.coupled ? 1 : past.metric;  // a coupled energy has the sheets' gradients
    const ValueAndDerivatives local = law.potential(value_of(c.value));   // p(c) of μ = p(c) − k Δ_Γ c
    if (law.edge_width > 0)
        add_surface_diffusion<Number>(mu, a * M * (energy.coupled ? p.delta_E : delta), p, row[molecule_density]);
    else if (M > 0)
        add_surface_diffusion<Number>(c, a * M * chain(c.value, local.first, local.second) * delta, p,
                                      row[molecule_density]);
    if (energy.coupled) return;
    row[molecule_potential].value = p.delta_floored * mu.value;
    if (law.edge_width == 0) return;
    row[molecule_potential].value += -1.0 * p.layer.delta * chain(c.value, local.value, local.first);
    add_surface_diffusion<Number>(c, -a * law.edge_width * p.layer.delta, p, row[molecule_potential]);
}

/// Molecules that come from outside and leave, δ_Γ j; the bulk that they come from is that of the step.
template <class Number>
void add_exchange(const Fields<Number>& x, const PointGeometry<Number>& p, const MembraneForces<Number>& force,
                  const PointPast& past, const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    if (step.exchange.none()) return;
    const Number& c = x[molecule_density].value;
    const Number j = step.exchange.rate<Number>(c, bending_by_concentration(energy, force.curvature, force.e_c, c),
                                                step.molecules, past.bulk);
    row[molecule_density].value = row[molecule_density].value - p.delta_Gamma * j;
}

/// (38): δ_Γ s is the membrane's material; where it enters at the rim s = 1.
template <class Number>
void add_stretching(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                    const StepNumbers& step, Fields<Number>& row) {
    const auto& s = x[membrane_stretch];
    add_transport(s.value, x, p, past, past.stretching, step, row[membrane_stretch]);
    add_surface_diffusion<Number>(s, stretch_diffusivity(step) * p.delta_floored, p, row[membrane_stretch]);
}

}  // namespace endoflow::phasefield::production
