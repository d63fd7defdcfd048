#pragma once

#include <deal.II/numerics/data_out.h>

#include <filesystem>
#include <vector>

#include "phasefield/monolithic/coupled_step.h"

namespace endoflow::phasefield {

/// Writes fields/fields_NNNNNN.vtu (one file for all processes) of `data` and fields.pvd with the times so far;
/// collective.
void write_field_file(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                      MPI_Comm communicator, const dealii::DataOut<2>& data);

/// The fields of scheme `paper`: velocity, pressure, lambda (the phase field's λ, half the sharp one), φ, membrane
/// force g, moment β f, c, μ, s; collective.
void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                  const Spaces& spaces, const State& state);

}  // namespace endoflow::phasefield
