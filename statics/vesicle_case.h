#pragma once

#include "shared/parameters/parameters.h"
#include "statics/vesicle_state.h"

namespace endoflow::statics {

/// A case with domain.kind = free_space as a problem of statics.
struct VesicleCase {
    ClosedMembrane membrane;  // area and volume are those of the case's spheroid
    VesicleFamily family;     // prolate or oblate as the spheroid is
};

/// Throws InputError when the membrane is not the same everywhere, i.e. the patch covers a part of it and makes a
/// difference, or when the spheroid is a sphere, which is its own only shape.
[[nodiscard]] VesicleCase vesicle_case(const Parameters& parameters);

}  // namespace endoflow::statics
