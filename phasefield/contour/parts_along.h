#pragma once

#include <vector>

#include "phasefield/fem/space.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield {

/// Of all processes' cells, the share that a part has, and what its elimination costs.
struct PartAlong {
    double cells, operations;
};

/// The mesh cut across the membrane into parts that cost the same, one per process: which of them an own cell is in.
/// `last`: the parts of a mesh much like this one; where there are none all cells cost the same. A cell's place is that
/// of the membrane's closest point. A part has two neighbours, and a cut is where it meets the fewest faces of cells,
/// among places that change a part by a hundredth or two. Collective.
std::vector<unsigned int> parts_along(const MembraneCurve& membrane, const Space& space,
                                      const std::vector<PartAlong>& last);

/// The parts that own cells are in, and what this process's one takes. Collective.
std::vector<PartAlong> measured_parts(const std::vector<unsigned int>& part_of_cell, double operations,
                                      const Space& space);

}  // namespace endoflow::phasefield
