#pragma once

#include "phasefield/schemes/interface/diagnostics.h"
#include "phasefield/schemes/production/point_equations.h"

namespace endoflow::phasefield::production {

/// Integrals over the layer and extrema on |φ| < 0.9 of one solution; collective.
struct SolutionMeasures {
    LayerIntegrals integrals;
    StepDiagnostics diagnostics;
    double step_difference;  // max |ψ − ψ_predicted| on |φ| < 0.9 [nm]
};

/// `before` and `predicted` give the motion and the difference to the predictor, `rate` is ∂/∂t of the fields [1/µs].
SolutionMeasures measure_solution(const Space& space, const BendingModel& model, const StepNumbers& step,
                                  const Vector& before, const Vector& predicted, const Vector& rate,
                                  const Vector& solution);

/// The same without a step: nothing moves.
SolutionMeasures measure_solution(const Space& space, const BendingModel& model, const StepNumbers& step,
                                  const Vector& solution);

/// max |increment of ψ| on |φ| < 0.9 [nm]; collective.
double layer_increment(const Space& space, double epsilon, const Vector& increment, const Vector& solution);

}  // namespace endoflow::phasefield::production
