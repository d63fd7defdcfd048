#pragma once

#include "phasefield/schemes/interface/diagnostics.h"
#include "phasefield/schemes/production/point_equations.h"

namespace endoflow::phasefield::production {

/// Integrals over the layer and extrema on |φ| < 0.9 of one solution; collective.
struct SolutionMeasures {
    LayerIntegrals integrals;
    StepDiagnostics diagnostics;
    double step_difference;  // max |ψ − ψ_predicted| on |φ| < 0.5 [nm]: further out layers may meet
    double layer_motion;  // the same of ψ − ψ_before where ε is largest; elsewhere as much larger as ε is smaller
    double molecules_rate;  // max |∂c/∂t| on |φ| < 0.9 [1/µs]
};

/// `before` and `predicted` give the motion and the difference to the predictor, `rate` is ∂/∂t of the fields [1/µs].
SolutionMeasures measure_solution(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                                  const Vector& before, const Vector& predicted, const Vector& rate,
                                  const Vector& solution);

/// The same without a step: nothing moves.
SolutionMeasures measure_solution(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                                  const Vector& solution);

/// ∫δ_Γ c alone [nm²] of each solution, a small part of the cost of measuring them; collective.
std::vector<double> molecules_of(const Space& space, const StepNumbers& step, const std::vector<Vector>& solutions);

/// max |increment of ψ| on |φ| < 0.9 in units of ε, times phase_field.epsilon [nm]; collective.
double layer_increment(const Space& space, const StepNumbers& step, const Vector& increment, const Vector& solution);

/// How much increments of each unknown count: 1, but next to nothing for what lives on the membrane where there is next
/// to nothing of it, w = (1 − φ²)² small, by w²/(w² + hardly_present²). On the ridges between layers these fields jump.
Vector presence(const Space& space, const StepNumbers& step, const Vector& solution);

}  // namespace endoflow::phasefield::production
