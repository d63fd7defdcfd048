#pragma once

#include "small_case.h"

namespace endoflow::phasefield {

/// A membrane of one stiffness that moves little, with molecules that stay where they are, steps of `first_step` µs at
/// first. Exactly at rest, at a `curvature` of 0, all increments would be round-off, of which Newton's method waits for
/// the hundredth part; at 1e-4 /nm the membrane stays flat to some pm.
inline Parameters flat_case(double curvature, double first_step) {
    Parameters p = small_case();
    p.membrane.spontaneous_curvature = curvature;
    p.membrane.bending_stiffness_coated = p.membrane.bending_stiffness;
    p.molecules.transport = Transport::advection;
    p.time.initial_step = first_step;
    return p;
}

}  // namespace endoflow::phasefield
