#pragma once

#include "phasefield/schemes/production/bending_equation.h"
#include "phasefield/schemes/production/flow_equations.h"
#include "phasefield/schemes/production/motion_equation.h"
#include "phasefield/schemes/production/normal_diffusion.h"
#include "phasefield/schemes/production/transport_equations.h"

namespace endoflow::phasefield::production {

// The weak form of the production scheme at one point, written once: with plain numbers it is the residual, with duals
// its exact Jacobian. Letters are those of docs/phase-field.md. The unknown is ψ with φ = tanh(ψ/(√2 ε)), so that all
// fields are smooth across the layer. A row's value multiplies the test function, its r and z the test function's
// derivatives: the row {f, F_r, F_z} is ∫ f v + F·∇v = 0.
//
// One weight δ_Γ (membrane_weight.h) weighs what acts along the membrane (tension, molecules, stretching, the step of
// the viscosity), so that the layer's first-order effects cancel, another one, δ_N, what acts along the normal (G and
// the motion of ψ), so that no force is blurred: what remains is O(ε²). The force on the fluid is δ_N G ∇ψ + δ_Γ e_c
// ∇c, where δ_N G is the variation of the discrete energy with respect to ψ, and ψ and c move with the same weights:
// then the work of the force is exactly the energy's change. Without that, motions at the scale of the cells gain
// energy and grow.
//
// Where ε changes along the membrane the layer's sheets are those of constant ψ/ε, with the normal N_ε. Along them acts
// the tension and flow molecules and membrane: δ_Γ is constant there. Along sheets of constant ψ the tension would pull
// at the layer's change of thickness, and shear it.

/// All rows at one point at radius r [nm].
template <class Number>
Fields<Number> point_equations(const Fields<Number>& x, double r, const PointPast& past,
                               const GradientChange<Number>& change, const StepNumbers& step,
                               const LayerEnergy& energy) {
    const PointGeometry<Number> p = point_geometry(x[distance], past, step.weight);
    Fields<Number> row;
    const MembraneForces<Number> force = add_bending(x, p, energy, r, past, change, row);
    add_flow(x, p, force, r, past, change, step, row);
    add_inextensibility(x, p, r, step, row);
    add_motion(x, p, past, step, row);
    add_molecules(x, p, past, step, energy, row);
    add_exchange(x, p, force, past, step, energy, row);
    add_stretching(x, p, past, step, row);
    add_normal_diffusions(x, p, past, step, energy, row);
    return row;
}

}  // namespace endoflow::phasefield::production
