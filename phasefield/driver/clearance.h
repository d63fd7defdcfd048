#pragma once

#include "shared/geometry/membrane_curve.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// Throws SolverError("membrane-near-wall", …) when the membrane is nearer than domain.wall_clearance to the bottom or
/// the top, or to the side wall anywhere but at its rim.
void require_clearance(const MembraneCurve& curve, const Parameters& parameters, double time);

}  // namespace endoflow::phasefield
