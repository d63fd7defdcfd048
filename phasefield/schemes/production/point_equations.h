#pragma once

#include "phasefield/schemes/production/bending_equation.h"
#include "phasefield/schemes/production/flow_equations.h"
#include "phasefield/schemes/production/motion_equation.h"
#include "phasefield/schemes/production/transport_equations.h"

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
//
// Where ε changes along the membrane the layer's sheets are those of constant ψ/ε, with the normal of g = ε ∇(ψ/ε) =
// ∇ψ − (ψ/ε) ∇ε. Along them acts the tension and flow molecules and membrane: δ_m is constant there. Along sheets of
// constant ψ the tension would pull at the layer's change of thickness, and shear it.

/// All rows at one point at radius r [nm].
template <class Number>
Fields<Number> point_equations(const Fields<Number>& x, double r, const PointPast& past,
                               const GradientChange<Number>& change, const StepNumbers& step,
                               const LayerEnergy& energy) {
    const PointGeometry<Number> p = point_geometry(x[distance], past.thickness, step.weight);
    Fields<Number> row;
    const BendingForces<Number> force = add_bending(x, p, energy, r, past, change, row);
    add_flow(x, p, force, r, past, change, step, row);
    add_inextensibility(x, p, past, r, step, row);
    add_motion(x, p, past, step, row);
    add_molecules(x, p, force, past, step, energy, row);
    add_exchange(x, p, force.sheet, past, step, energy, row);
    add_stretching(x, p, past, step, row);
    return row;
}

}  // namespace endoflow::phasefield::production
