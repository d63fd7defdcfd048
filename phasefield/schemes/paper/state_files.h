#pragma once

#include <filesystem>
#include <vector>

#include "phasefield/schemes/paper/discretization.h"

namespace endoflow::phasefield::paper {

/// Writes mesh and state into a directory of their own; collective. A run may be continued on any number of processes.
void save_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization, const State& state);

/// Reads them into a discretization that is still on its coarse mesh. Throws IoError.
State load_mesh_and_state(const std::filesystem::path& directory, Discretization& discretization);

/// The fields of scheme `paper`: velocity, pressure, lambda (the phase field's λ, half the sharp one), φ, membrane
/// force g, moment β f (or f, where that is the unknown), c, μ, s; collective.
void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                  const Spaces& spaces, const State& state, const PaperSchemeParameters& numerics);

}  // namespace endoflow::phasefield::paper
