#pragma once

#include "phasefield/schemes/production/energy_arguments.h"
#include "phasefield/schemes/production/layer_energy.h"

namespace endoflow::phasefield::production {

// The energy, (L) of docs/phase-field.md, is the stationary value over m of
//
//   E[ψ, m, c] = ∫ δ_E (−m κ_ε − e*_ε(−m, c)) − ½ D_m δ_E (∇ψ·∇m)² dx,   κ_ε = −Δψ + (δ_E'/2δ_E) (1 − |∇ψ|²).
//
// The Laplacian is integrated by parts, ∫ δ_E m Δψ = −∫ ∇ψ·∇(δ_E m), where ∇δ_E = δ_E' ∇ψ + ∂δ_E/∂ε ∇ε: W below is the
// density of what results, and holds first derivatives alone. Its rows are its derivatives,
//
//   −∂E/∂m [v]  = −∫ ∂W/∂m v + ∂W/∂∇m·∇v,      ∫ δ_N G χ − ∂E/∂ψ[χ] = ∫ (δ_N G − ∂W/∂ψ) χ − ∂W/∂∇ψ·∇χ,
//
// and, where the energy knows ∇_Γ c, ∫ δ_E μ v − ∂E/∂c [v] in the same way. This κ_ε belongs to this weight: with that
// of δ the cut of δ_E would exert a force on curved membranes that does not vanish with ε. The last term of (L) keeps m
// constant along the normal: a sharp membrane has one curvature, not one for each level set.

template <class Number>
struct EnergyDensity {
    Number W;              // [pN/nm²]
    Number at_given_bend;  // the integrand of (L) but for δ_E m Δψ [pN/nm²]
    Number delta_E;        // [1/nm]
    Number conjugate;      // e*_ε [pN/nm]
};

/// W(ψ, ∇ψ, m, ∇m, c, ∇c; ε, ∇ε; r) with e*_ε and δ_E as they are at this point. The thickness as data, not as
/// argument, is what ∇ε and the sheets' direction are taken from.
template <class Number>
EnergyDensity<Number> energy_density(const EnergyArguments<Number>& x, double r, const PointThickness& thickness,
                                     const LayerEnergy& energy, const SheetEnergy& sheet,
                                     const ScaledEnergyWeight& scaled) {
    const auto& [psi, m, c, epsilon] = x;
    const auto [delta_E, slope, widening] = energy_weight(psi.value, epsilon, scaled);
    const Number along = energy.coupled ? along_sheet(c, sheet_normal(psi, thickness).N_epsilon) : Number(0.0);
    const Number conjugate = sheet.conjugate(sheet_point(energy, m.value, c.value, along, psi.r, r, epsilon), epsilon);
    const Number squared = dot(psi, psi), tilt = dot(psi, m);  // |∇ψ|², ∇ψ·∇m
    const Number at_given_bend = -0.5 * slope * m.value * (1.0 - squared) - delta_E * conjugate -
                                 0.5 * energy.compliance(epsilon) * delta_E * tilt * tilt;
    const Number laplacian = delta_E * tilt + m.value * (slope * squared + widening * dot(thickness, psi));
    const Number W = at_given_bend - laplacian - 0.5 * energy.smoothing(thickness.value) * dot(m, m);
    return {W, at_given_bend, delta_E, conjugate};
}

/// Taken off the row of G, as a flux: molecules turn with the membrane's normals. G is ∂E/∂ψ at given c(x). Where a
/// motion χ turns the normals by ∂ₜχ, the molecules of the sheet at the distance ψ, at rest in space, lag behind by
/// ψ ∂ₜχ, and because sheets have different areas E changes by M₂ κ₂ e_c ∂ₜc ∂ₜχ, κ₂ = ∂_rψ/r. A membrane takes its
/// molecules with it, so this is no force of it; it would leave a net one, of ε². A coupled energy's ∂E/∂c is taken as
/// it is, with all of E.
template <class Number>
PlaneVector<Number> turning_molecules(const Number& delta_E, const Number& k, const Number& e_c, const Number& along,
                                      const PointGeometry<Number>& p) {
    const Number lag = (-energy_second_moment * p.epsilon) * k * delta_E * e_c * along;
    return {-1.0 * lag * p.N_epsilon.z, lag * p.N_epsilon.r};
}

/// ∂ε/∂ψ along ∇ψ, which interpolation in cells leaves of a thickness that is constant along the normal.
template <class Number>
Number thickness_across(const AtPoint<Number>& psi, const PointThickness& thickness) {
    return dot(thickness, psi) / (dot(psi, psi) + gradient_floor * gradient_floor);
}

/// Taken off the row of G, as a flux: the thickness turns with the membrane's normals, too. Where χ turns them, ε at
/// the distance ψ lags behind by ψ ∂ₜε ∂ₜχ, arcs measured on the membrane, and E changes by E_ε, its derivative by ε at
/// given ψ, m and c, times that. So E, which is that of the sharp membrane whatever ε, exerts no force by ∇ε along the
/// membrane. (E_ε ∇ε on the fluid would balance the row without that, but E_ε, whose sum across the layer vanishes, is
/// of either sign there: it would shear the layer, and a membrane that cannot stretch would slip, and swim.) As far as
/// ε is not constant along the normal, E_ε ∂ε/∂ψ ∇ψ acts on the fluid.
template <class Number>
PlaneVector<Number> turning_thickness(const Number& E_epsilon, const AtPoint<Number>& psi, const PointPast& past) {
    const Number across = thickness_across(psi, past.thickness), turned = past.arc * psi.value * E_epsilon;
    return {turned * (past.thickness.r - across * psi.r), turned * (past.thickness.z - across * psi.z)};
}

/// What the fluid and the molecules feel of the energy beside G.
template <class Number>
struct MembraneForces {
    Number e_c;        // or μ of a coupled energy [pN/nm]
    Number thickness;  // E_ε ∂ε/∂ψ [pN/nm³]
    Number curvature;  // κ of a coupled energy [1/nm]
};

/// Rows of m, G and, of a coupled energy, μ, by derivatives of W in its first `count` arguments.
template <std::size_t count, class Number>
MembraneForces<Number> add_derivatives(const Fields<Number>& x, const PointGeometry<Number>& p,
                                       const LayerEnergy& energy, double r, const PointPast& past,
                                       const GradientChange<Number>& change, Fields<Number>& row) {
    const auto &psi = x[distance], &m = x[moment], &c = x[molecule_density];
    const Number along = along_sheet(c, p.N_epsilon);
    const auto at = sheet_point(energy, m.value, c.value, along, psi.r, r, p.epsilon);
    const SheetEnergy sheet(energy, values_of(at), p.epsilon);
    const auto here = listed<count>(EnergyArguments<Number>{psi, m, c, p.epsilon});
    const auto density = energy_density(differentiated(here), r, past.thickness, energy, sheet, p.scaled_delta_E);
    const auto W_by = [&](argument::Index a) { return compose_partial(density.W, a, here); };
    row[moment] = {-W_by(argument::m), -W_by(argument::m_r), -W_by(argument::m_z)};
    row[normal_force] = {(p.delta_N + surface_floor / p.epsilon) * x[normal_force].value - W_by(argument::psi),
                         -W_by(argument::psi_r), -W_by(argument::psi_z)};

    const Number E_epsilon = compose_partial(density.at_given_bend, argument::epsilon, here) +
                             compose_partial(density.delta_E, argument::epsilon, here) * m.value * change.laplacian;
    add_flux(turning_thickness(E_epsilon, psi, past), row[normal_force]);
    const Number thickness = E_epsilon * thickness_across(psi, past.thickness);
    if constexpr (count == argument::without_gradient) {
        const Number e_c = sheet.by_concentration(at, p.epsilon);
        add_flux(turning_molecules(p.delta_E, at.k, e_c, along, p), row[normal_force]);
        return {e_c, thickness, {}};
    } else {
        const Number& mu = x[molecule_potential].value;
        row[molecule_potential] = {(p.delta_E + surface_floor / p.epsilon) * mu - W_by(argument::c),
                                   -W_by(argument::c_r), -W_by(argument::c_z)};
        return {mu, thickness, -compose_partial(density.conjugate, argument::m, here)};
    }
}

/// The same where δ_E is nothing: of W the smoothing of m is left, of the rows the floors.
template <class Number>
MembraneForces<Number> add_beyond_layer(const Fields<Number>& x, double epsilon, const LayerEnergy& energy,
                                        Fields<Number>& row) {
    const auto &m = x[moment], &G = x[normal_force], &mu = x[molecule_potential];
    const double floor = surface_floor / epsilon, smoothing = energy.smoothing(epsilon);
    row[moment] = {0.0, smoothing * m.r, smoothing * m.z};
    row[normal_force].value = floor * G.value;
    if (energy.coupled) row[molecule_potential].value = floor * mu.value;
    return {};
}

template <class Number>
MembraneForces<Number> add_bending(const Fields<Number>& x, const PointGeometry<Number>& p, const LayerEnergy& energy,
                                   double r, const PointPast& past, const GradientChange<Number>& change,
                                   Fields<Number>& row) {
    if (std::abs(value_of(x[distance].value)) > energy_reach * p.epsilon)
        return add_beyond_layer(x, p.epsilon, energy, row);
    return energy.coupled ? add_derivatives<argument::count>(x, p, energy, r, past, change, row)
                          : add_derivatives<argument::without_gradient>(x, p, energy, r, past, change, row);
}

}  // namespace endoflow::phasefield::production
