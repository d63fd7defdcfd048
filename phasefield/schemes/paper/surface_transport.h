#pragma once

#include "phasefield/schemes/paper/coupled_step.h"

namespace endoflow::phasefield::paper {

/// Step 2 of Sec. 3: s from (38) with the inflow condition (31). `flow_old` and `flow_new` hold φⁿ and (u, φ)ⁿ⁺¹;
/// `stretching` goes from sⁿ to sⁿ⁺¹. ∫|∇φ| s changes by the membrane that flows in at the rim and by nothing else.
void advance_stretching(const Spaces& spaces, const Vector& flow_old, const Vector& flow_new,
                        const Parameters& parameters, double tau, LinearSystem& system, Vector& stretching);

/// Step 3 of Sec. 3: c (and μ) from (40)-(41), (39) or (39) with D_c = 0. ∫|∇φ| c is conserved to round-off.
void advance_molecules(const Spaces& spaces, const Vector& flow_old, const Vector& flow_new,
                       const Parameters& parameters, double tau, LinearSystem& system, Vector& molecules);

/// |∇φ| as the weight of the surface equations: floored far from the layer, where it would leave them without a
/// solution.
double layer_weight(double gradient, double epsilon);

}  // namespace endoflow::phasefield::paper
