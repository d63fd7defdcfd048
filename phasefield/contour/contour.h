#pragma once

#include "phasefield/contour/cell_contour.h"
#include "phasefield/fem/mesh.h"
#include "shared/geometry/membrane_curve.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// The level set as a curve from the axis to the rim, or of a vesicle from its upper pole to the lower. Points lie on
/// the discrete zero set to round-off, κ comes from the level-set function's derivatives, and lambda is the sharp
/// tension.
struct Contour {
    MembraneCurve curve;
    unsigned int components;  // 1, or more when the membrane has changed its topology
};

/// The zero level set in pieces, all of them on all processes; collective.
std::vector<ContourSegment> contour_segments(const ContourFields& fields);

/// Collective; the result is the same on all processes. Throws SolverError("membrane-lost", …) when φ = 0 does not
/// connect the rim, or the lower pole, with the axis.
Contour extract_contour(const ContourFields& fields, const Parameters& parameters);

/// The positions alone.
std::vector<PlanePoint> positions(const MembraneCurve& curve);

}  // namespace endoflow::phasefield
