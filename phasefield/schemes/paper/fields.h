#pragma once

#include "phasefield/fem/space.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::paper {

/// Components of the coupled system of Sec. 3, step 1. `moment` is β f, or f where bending_unknown says so.
enum FlowComponent : unsigned int { u_r = 0, u_z = 1, pressure = 2, tension = 3, phi = 4, force = 5, moment = 6 };
inline constexpr unsigned int n_flow_components = 7;

/// Components of the molecules' system (40)-(41).
enum MoleculeComponent : unsigned int { concentration = 0, potential = 1 };

/// Degrees of the coupled system's components in the order of FlowComponent.
std::vector<unsigned int> flow_degrees(const PhaseFieldParameters& parameters);

/// Closes the constraints of the coupled system (values of the increments):
/// u_r = 0 on the axis; u_z = 0 on r = R for |z − z₀| ≤ δ; λ = 0 on the outer boundary; φ fixed on r = R, whose test
/// function belongs to the g row. Without flow (geometric dynamics) u, p and λ are switched off; without
/// inextensibility λ is.
void close_flow_constraints(Space& space, const Parameters& parameters);

}  // namespace endoflow::phasefield::paper
