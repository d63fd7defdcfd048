#pragma once

#include <string>

#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/output/checkpoint.h"

namespace endoflow::boundary_integral {

/// The point that a resumed integration starts from, in a checkpoint.
void save(const StartingPoint& start, Checkpoint& checkpoint);

/// Throws IoError when the checkpoint, which lies in `directory`, does not hold `size` unknowns.
[[nodiscard]] StartingPoint restored_start(const Checkpoint& checkpoint, Eigen::Index size,
                                           const std::string& directory);

}  // namespace endoflow::boundary_integral
