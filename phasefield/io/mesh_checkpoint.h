#pragma once

#include <filesystem>

#include "phasefield/evolution/discretization.h"

namespace endoflow::phasefield {

/// Writes mesh and state into a directory of their own; collective. A run may be continued on any number of processes.
void save_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization, const State& state);

/// Reads them into a discretization that is still on its coarse mesh. Throws IoError.
State load_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization);

}  // namespace endoflow::phasefield
