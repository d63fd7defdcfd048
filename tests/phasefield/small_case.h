#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// The standard membrane with a small patch in a small box, coarse enough to step in a fraction of a second.
inline Parameters small_case() {
    Parameters p;
    p.domain.radius = 40;
    p.domain.height = 40;
    p.domain.membrane_height = 20;
    p.molecules.patch_radius = 16;
    p.molecules.interface_width = 3;
    p.phase_field.epsilon = 2.4;
    p.phase_field.cell_size = 2.5;
    p.phase_field.far_refinements = 2;
    p.time.initial_step = 1.25e-6;  // µs: so few cells know shorter steps better
    return p;
}

}  // namespace endoflow::phasefield
