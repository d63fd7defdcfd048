#pragma once

#include "phasefield/schemes/production/layer_energy.h"

namespace endoflow::phasefield::production {

/// What the fluid feels beside G ∇ψ, and the elastic state.
template <class Number>
struct BendingForces {
    Number along, across;  // ∂e/∂c or μ: along the sheets cut off in the tails [pN/nm], across with δ_E [pN/nm²]
    Number weight;         // δ_E [1/nm]
    Number of_thickness;   // E_ε ∂ε/∂ψ per volume, along ∇ψ [pN/nm³]
    SheetState<Number> sheet;
};

/// The membrane's energy as a functional of ψ, the moment b and c whose stationary value over b is E:
///
///   E = ∫ w (b h − e*(−b, c)) − ½ D w (∇ψ·∇b)² dx,   h = Δψ − w' (1 − |∇ψ|²)/(2w),   w the weight above,
///
/// e* the Legendre transform of the energy per area, for bending alone b²/(2 β) − b C, and −h the layer's curvature;
/// the Laplacian of ψ integrated by parts, with what w depends on x by ε taken off: b ∂w/∂ε ∇ε·∇ψ. With w = δ this h is
/// the one at the top of this page; with another h a weight that is cut off exerts a force on curved membranes, one
/// that does not vanish with ε. The last term keeps b constant along the normal: a sharp membrane has one curvature,
/// not one for each level set. Its derivatives with respect to b, ψ and c are the rows of b and of the normal force G
/// and the force e ∇c, so that the discrete equations obey the energy law. G is kept constant along the normal: what
/// varies there is the force that keeps the profile, which the profile's relaxation takes over. Acting on the fluid it
/// would drive a flow within the layer that the relaxation undoes all the time.
///
/// An energy that knows the gradient along the sheets, t·∇c, has ∂E/∂c with a divergence in it: μ is then the field
/// whose row this is, w μ = ∂E/∂c, and takes the place of ∂e/∂c in the force. On sheets of other lengths it would be
/// another one, and molecules that are constant along the normal are driven by its mean: it is kept constant there,
/// without which what it does across the layer and in its tails would dissipate some per cent of the fluid's power. The
/// sheets' direction depends on ψ; what that adds to G vanishes where c is constant along the normal.
///
/// That sheets on both sides of a curved membrane have together a larger area than the membrane is accounted for in e*
/// (sheet_state): E is that of the sharp membrane up to ε⁴. So is its variation at constant c, but that is not the one
/// of the sharp membrane, which takes its molecules with it: where a motion χ turns the normals by t·∇χ, the sheets'
/// molecules, at rest in space, lag behind by ψ t·∇χ, and of E's change M₂ κ₂ (∂e/∂c) t·∇c t·∇χ, κ₂ = ψ_r/r, is theirs.
/// It is taken off: else G would be off by ε², and the layer would exert a net force. A coupled energy's ∂E/∂c is taken
/// as it is, with all of E.
///
/// The thickness turns with the normals, too: where χ turns them, ε at the distance ψ lags behind by ψ ∂ₜε ∂ₜχ, ∂ₜ
/// along the sheets and arcs measured on the membrane, and of E's change E_ε = ∂E/∂ε at given ψ, b and c times that is
/// taken off. E, which is that of the sharp membrane whatever ε, then exerts no force by ∇ε along the membrane. (E_ε ∇ε
/// on the fluid would balance the row without that, but E_ε, whose sum across the layer vanishes, is of either sign
/// there: it would shear the layer, and a membrane that cannot stretch would slip, and swim.) As far as ε, interpolated
/// in cells, is not constant along the normal E_ε ∂ε/∂ψ ∇ψ is left.
template <class Number>
BendingForces<Number> add_bending(const Fields<Number>& x, const PointGeometry<Number>& p, const LayerEnergy& energy,
                                  double r, const PointPast& past, const GradientChange<Number>& change,
                                  Fields<Number>& row) {
    const auto &psi = x[distance], &b = x[moment];
    const auto& c = x[molecule_density];
    const Number along = c.z * p.normal_r - c.r * p.normal_z;
    const SheetCurvature<Number> around = sheet_curvature(psi.r, r, p.epsilon);
    const SheetState<Number> sheet = sheet_state(energy, b.value, c.value, along, around.scaled, p.epsilon);
    const ElasticState<Number>& elastic = sheet.elastic;
    const Number& conjugate = sheet.conjugate;
    const EnergyWeight<Number> w = energy_weight(p.layer, psi.value, p.epsilon);
    const Number mean = 0.5 * (1.0 + p.squared_gradient);
    const double smoothing = energy.smoothing(p.epsilon);
    row[moment] = {w.first * mean - w.value * elastic.curvature, w.value * psi.r + smoothing * b.r,
                   w.value * psi.z + smoothing * b.z};
    const auto& thickness = past.thickness;
    const Number thinning = thickness.r * psi.r + thickness.z * psi.z, twist = w.first * b.value;
    row[moment].value += w.thickness * thinning;
    row[normal_force] = {(p.density + surface_floor / p.epsilon) * x[normal_force].value +
                             w.first * (psi.r * b.r + psi.z * b.z + conjugate) + w.second * mean * b.value +
                             w.thickness_1 * b.value * thinning,
                         w.value * b.r + twist * psi.r + (thickness.r * w.thickness) * b.value +
                             w.value * sheet.by_curvature * around.slope,
                         w.value * b.z + twist * psi.z + (thickness.z * w.thickness) * b.value};
    add_alignment(x[normal_force], own_normal(psi, past), force_diffusivity(p), row[normal_force]);
    const double compliance = energy.compliance(p.epsilon);
    const Number slope = psi.r * b.r + psi.z * b.z, flux = compliance * w.value * slope;
    row[moment].r += flux * psi.r;
    row[moment].z += flux * psi.z;
    row[normal_force].value += (0.5 * compliance) * w.first * slope * slope;
    row[normal_force].r += flux * b.r;
    row[normal_force].z += flux * b.z;
    const Number by_thickness = w.thickness * (change.laplacian * b.value - conjugate) -
                                w.thickness_1 * b.value * (1.0 - mean) -
                                w.value * (sheet.by_thickness + sheet.by_curvature * around.by_thickness) -
                                compliance * (0.5 * w.thickness + (1 / p.epsilon) * w.value) * slope * slope;
    const Number across = thinning / (p.squared_gradient + gradient_floor * gradient_floor);
    const Number turned = past.arc * psi.value * by_thickness, of_thickness = by_thickness * across;
    row[normal_force].r += turned * (thickness.r - across * psi.r);
    row[normal_force].z += turned * (thickness.z - across * psi.z);
    if (!energy.coupled) {
        const Number& potential = sheet.by_concentration;
        const Number lag = (-energy_second_moment * p.epsilon) * around.scaled * w.value * potential * along;
        row[normal_force].r = row[normal_force].r - lag * p.normal_z;
        row[normal_force].z += lag * p.normal_r;
        return {w.kept * potential, w.value * potential, w.value, of_thickness, sheet};
    }

    const Number line = 2.0 * w.value * elastic.by_squared_gradient * along, turning = line * p.inverse_gradient;
    const Number by_r = turning * (c.z - along * p.normal_r), by_z = -1.0 * turning * (c.r + along * p.normal_z);
    row[normal_force].r = row[normal_force].r - by_r;
    row[normal_force].z = row[normal_force].z - by_z;
    row[normal_force].value += (thickness.r / p.epsilon) * by_r + (thickness.z / p.epsilon) * by_z;
    const Number& mu = x[molecule_potential].value;
    row[molecule_potential] = {(w.value + surface_floor / p.epsilon) * mu - w.value * elastic.by_concentration,
                               line * p.normal_z, -1.0 * line * p.normal_r};
    add_alignment(x[molecule_potential], past.normal, (potential_alignment * p.epsilon * p.epsilon) * w.value,
                  row[molecule_potential]);
    return {w.kept * mu, w.value * mu, w.value, of_thickness, sheet};
}

}  // namespace endoflow::phasefield::production
