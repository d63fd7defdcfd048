#pragma once

#include <filesystem>
#include <vector>

#include "phasefield/monolithic/coupled_step.h"

namespace endoflow::phasefield {

/// fields/fields_NNNNNN.vtu (one file for all processes) and fields.pvd with the times so far; collective.
/// Fields: velocity, pressure, tension (the phase field's λ, half the sharp one), φ, membrane force g, moment β f, c,
/// μ.
void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                  const Spaces& spaces, const State& state);

}  // namespace endoflow::phasefield
