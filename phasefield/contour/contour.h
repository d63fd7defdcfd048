#pragma once

#include "phasefield/discretization/mesh.h"
#include "phasefield/monolithic/coupled_step.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield {

/// The set φ = 0 as a curve from the axis to the rim. Points lie on the discrete φ's zero set to round-off; κ comes
/// from the derivatives of φ and lambda is the sharp tension 2 λ, since ∫|∇φ| across the layer is 2.
struct Contour {
    MembraneCurve curve;
    unsigned int components;  // 1, or more when the membrane has changed its topology
};

/// Collective; the result is the same on all processes. Throws SolverError("membrane-lost", …) when φ = 0 does not
/// connect the rim with the axis.
Contour extract_contour(const Spaces& spaces, const State& state, const Parameters& parameters);

/// The positions alone.
std::vector<PlanePoint> positions(const MembraneCurve& curve);

}  // namespace endoflow::phasefield
