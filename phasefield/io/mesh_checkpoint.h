#pragma once

#include <filesystem>

#include "phasefield/evolution/discretization.h"

namespace endoflow::phasefield {

/// Makes an empty directory in the place of what is there; collective.
void make_empty_directory(const std::filesystem::path& directory, MPI_Comm communicator);

/// Reads a saved mesh in the place of the coarse one. Throws IoError.
void load_mesh(const std::filesystem::path& directory, Mesh& mesh);

/// Writes mesh and state into a directory of their own; collective. A run may be continued on any number of processes.
void save_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization, const State& state);

/// Reads them into a discretization that is still on its coarse mesh. Throws IoError.
State load_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization);

}  // namespace endoflow::phasefield
