#pragma once

// Single and double layer of the membrane for all azimuthal modes at once:
//     single(x0) = int_Gamma f.G dS,    doubled(x0) = PV int_Gamma u.T.n dS,
// from physical coefficients of ModeSpace to (r, phi, z) amplitudes at targets.

#include <vector>

#include "boundary_integral/modes/mode_space.h"
#include "boundary_integral/operators/layer_target.h"

namespace endoflow::boundary_integral {

struct ModeLayers {
    RowMatrix single;   // rows x force_count
    RowMatrix doubled;  // rows x velocity_count
};

/// Rows 3 i ... 3 i + 2 for target i: r, phi, z.
[[nodiscard]] inline TargetRows mode_rows(Index i) {
    return {3 * i, 3 * i + 2, 3 * i + 1};
}

/// One entry per mode 0 ... highest; rows of target i as mode_rows(i) has them.
[[nodiscard]] std::vector<ModeLayers> mode_layers(const MembraneSpace& space, const ParitySpaces& spaces,
                                                  const MembraneState& state, const std::vector<LayerTarget>& targets,
                                                  int highest_mode, int threads);

}  // namespace endoflow::boundary_integral
