#pragma once

#include <vector>

#include "phasefield/fem/space.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield {

/// The mesh cut across the membrane into parts of as many cells each, one per process: which of them an own cell is in.
/// A cell's place is that of the membrane's closest point. A part has two neighbours, and a cut is where it meets the
/// fewest faces of cells, among places that change a part by a twentieth at most. Collective.
std::vector<unsigned int> parts_along(const MembraneCurve& membrane, const Space& space);

}  // namespace endoflow::phasefield
