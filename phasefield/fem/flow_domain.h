#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// The half plane 0 < r < radius, bottom < z < top that the fluid fills [nm].
struct FlowDomain {
    double radius, bottom, top;
};

/// The case's box; around a vesicle in free space one of phase_field.free_space times its longer semi-axis.
FlowDomain flow_domain(const Parameters& parameters);

/// How often the coarsest cells are halved at the membrane: phase_field.far_refinements times, and once more for each
/// doubling of the distance from axis to side beyond 48 of the membrane's cells.
unsigned int layer_level(const Parameters& parameters);

}  // namespace endoflow::phasefield
