#pragma once

#include <algorithm>

#include "phasefield/schemes/production/bending_equation.h"

namespace endoflow::phasefield::production {

inline constexpr double crowding_length = constant("crowding_length");

/// ∂(δ_m y)/∂t + ∇·(δ_m y v), v the fluid's velocity along the membrane and the level sets' own velocity across it. The
/// two differ where the profile is being restored; with the fluid's velocity alone y would grow in the layer's tails.
/// Across, δ_m v is −(∂H/∂t) n/g with H = ∫ δ_m dψ, for with BDF's ∂H/∂t a plane membrane keeps a constant y however
/// far it moves in a step; δ_m ∂ψ/∂t instead leaves an error of the order of (motion/ε)³.
template <class Number>
void add_transport(const Number& y, const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
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
/// did with normals that lagged behind in the layer's tails by as little as a tenth of a step. On cells c is constant
/// along the normal but for an error, and what D_n moves there also goes along the membrane, out of the coat. So D_n
/// fades with the shear, which goes with the membrane's speed.
inline double normal_diffusivity_of_molecules(double epsilon, const StepNumbers& step) {
    const double least = step.molecules_alignment * step.rates.least_normal_diffusivity / (epsilon * epsilon * epsilon);
    return within_a_step(std::max(step.normal_diffusivity, least), epsilon, step);
}

/// D ∇_Γ y along the sheets: across them δ may change where the layer thins, and y would follow. Diffusion over the
/// membrane is that over its sheets where D has the sheets' metric in it: on them a length along the meridian is 1 +
/// κ₁ψ times as long, the gradient as much smaller, and ∫ δ (1 + κ₂ψ)/(1 + κ₁ψ) dψ is 1 + 0.645 (κ₁ε)²: 2 % at the edge
/// of a coat, where a membrane bends most.
template <class Number>
void add_surface_diffusion(const AtPoint<Number>& y, const Number& diffusivity, const PointGeometry<Number>& p,
                           AtPoint<Number>& row) {
    const Number flux = diffusivity * (y.z * p.normal_r - y.r * p.normal_z);
    row.r += (-1.0) * flux * p.normal_z;
    row.z += flux * p.normal_r;
}

/// What the tension leaves of P:∇u within a cell diffuses away in s, as fast as ζ relaxes s over a cell, and as fast as
/// crowded molecules would crowd the membrane further [nm²/µs].
inline double stretch_diffusivity(const StepNumbers& step) {
    const double h = step.numerics.cell_size;
    return step.numerics.stretching_diffusivity +
           std::max(step.rates.strain_relaxation * h * h, crowding_length * h * step.rates.crowding);
}

/// The molecules ride on the membrane that the diffusion of s, D_s ∇_Γ s, moves along itself. Where P:∇u crowds the
/// membrane within a cell it crowds c, too, and the force e ∇c crowds both further, at a rate of e c k/(ν₁ + ν₂) for
/// wave numbers k that the tension does not reach. Diffusion of c would hold that back, too, but spread the coat. A
/// membrane that may stretch keeps its s, and its molecules stay.
template <class Number>
void add_redistribution(const Number& c, const AtPoint<Number>& s, const PointGeometry<Number>& p, const Number& weight,
                        const StepNumbers& step, AtPoint<Number>& row) {
    add_surface_diffusion(s, stretch_diffusivity(step) * weight * c, p, row);
}

/// (40), (41), or (39), or (14): δ_m c is conserved under the case's transport law. The potential is a field of its own
/// where it holds ∇_Γ c; that of a coupled energy is add_bending's. The diffusion along the membrane ends where δ_m
/// does: on the coarse cells beyond, the double well would have several solutions where the layers of bud and plane
/// meet.
template <class Number>
void add_molecules(const Fields<Number>& x, const PointGeometry<Number>& p, const BendingForces<Number>& force,
                   const PointPast& past, const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    const auto &c = x[molecule_density], &mu = x[molecule_potential];
    add_transport(c.value, x, p, past, past.molecules, step, row[molecule_density]);
    const Number phi2 = p.layer.phi * p.layer.phi, weight = cut_density(p.layer);
    add_alignment(c, past.molecules_normal, past.even * normal_diffusivity_of_molecules(p.epsilon, step) * p.surface,
                  row[molecule_density]);
    add_diffusion(c, step.rates.molecule_leak * (phi2 * phi2), row[molecule_density]);
    if (step.inextensible) add_redistribution(c.value, x[membrane_stretch], p, weight, step, row[molecule_density]);
    const TransportLaw& law = step.transport;
    const double metric = energy.coupled ? 1 : past.metric;  // a coupled energy has the sheets' own gradients
    const ValueAndDerivatives local = law.potential(value_of(c.value));
    if (law.edge_width > 0) {
        const Number conducting = energy.coupled ? force.weight : weight;
        add_surface_diffusion<Number>(mu, metric * law.mobility * conducting, p, row[molecule_density]);
    } else if (law.mobility > 0) {
        const Number diffusivity = chain(c.value, local.first, local.second);
        add_surface_diffusion<Number>(c, metric * law.mobility * diffusivity * weight, p, row[molecule_density]);
    }
    if (energy.coupled) return;
    row[molecule_potential].value = p.surface * mu.value;
    if (law.edge_width == 0) return;
    row[molecule_potential].value = p.surface * mu.value - p.layer.delta * chain(c.value, local.value, local.first);
    add_surface_diffusion<Number>(c, -metric * law.edge_width * p.layer.delta, p, row[molecule_potential]);
}

/// Molecules that come from outside and leave, δ_m j; the bulk that they come from is that of the step.
template <class Number>
void add_exchange(const Fields<Number>& x, const PointGeometry<Number>& p, const SheetState<Number>& sheet,
                  const PointPast& past, const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    if (step.exchange.none()) return;
    const Number& c = x[molecule_density].value;
    const Number rate =
        step.exchange.rate<Number>(c, bending_by_concentration(energy, sheet, c), step.molecules, past.bulk);
    row[molecule_density].value = row[molecule_density].value - p.density * rate;
}

/// (38): δ_m s is the membrane's material; where it enters at the rim s = 1.
template <class Number>
void add_stretching(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                    const StepNumbers& step, Fields<Number>& row) {
    const auto& s = x[membrane_stretch];
    add_transport(s.value, x, p, past, past.stretching, step, row[membrane_stretch]);
    add_alignment(s, past.normal,
                  past.even * within_a_step(step.rates.stretching_alignment, p.epsilon, step) * p.surface,
                  row[membrane_stretch]);
    add_surface_diffusion<Number>(s, stretch_diffusivity(step) * p.surface, p, row[membrane_stretch]);
}

}  // namespace endoflow::phasefield::production
