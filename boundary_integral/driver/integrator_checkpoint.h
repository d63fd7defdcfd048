#pragma once

#include <string>

#include "boundary_integral/evolution/stiff_integrator.h"
#include "shared/output/checkpoint.h"

namespace endoflow::boundary_integral {

/// The integrator's history in a checkpoint.
void save(const StepHistory& history, Checkpoint& checkpoint);

/// Throws IoError when the checkpoint, which lies in `directory`, does not hold `size` unknowns.
[[nodiscard]] StepHistory restored_history(const Checkpoint& checkpoint, Eigen::Index size,
                                           const std::string& directory);

}  // namespace endoflow::boundary_integral
