#pragma once

// Single and double layer of the membrane for all azimuthal modes at once:
//     single(x0) = int_Gamma f.G dS,    doubled(x0) = PV int_Gamma u.T.n dS,
// from physical coefficients of ModeSpace to (r, phi, z) amplitudes at targets.

#include <vector>

#include "boundary_integral/modes/mode_space.h"
#include "boundary_integral/operators/layer_block.h"

namespace endoflow::boundary_integral {

struct ModeTarget {
    Target at;
    double xi = -1.0;  // parameter when the target lies on the membrane, -1 otherwise
};

/// Rows 3 i ... 3 i + 2 belong to target i.
struct ModeLayers {
    RowMatrix single;   // 3 targets x force_count
    RowMatrix doubled;  // 3 targets x velocity_count
};

/// One entry per mode 0 ... highest.
[[nodiscard]] std::vector<ModeLayers> mode_layers(const MembraneSpace& space, const ParitySpaces& spaces,
                                                  const MembraneState& state, const std::vector<ModeTarget>& targets,
                                                  int highest_mode, int threads);

}  // namespace endoflow::boundary_integral
