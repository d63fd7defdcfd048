#pragma once

#include <vector>

#include "phasefield/fem/mesh.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield::production {

/// The mesh follows when the membrane has moved this far [nm]; less without a flow, whose velocity tells where it goes.
double follow_after_motion(const Parameters& parameters);

/// Where the mesh is fine, here and where the membrane will be when the mesh follows again: around the whole membrane,
/// finer where it is thin and coarser where it is thick (as ε), at the patch's edge (three quarters of its width) and
/// where the membrane is narrow (a quarter of its radius of curvature around the axis, r/|n_r|, but at least a quarter
/// of `cell_size`): normals fan out there, and on coarser cells what varies along the membrane within one of them
/// drives flows that carry most of the dissipation.
std::vector<RefinedBand> refined_bands(const MembraneCurve& curve, const Parameters& parameters);

/// How far the edge of the coat, c = ½, is from where it was [nm]; 0 where one of the membranes has none.
double edge_motion(const MembraneCurve& before, const MembraneCurve& after);

}  // namespace endoflow::phasefield::production
