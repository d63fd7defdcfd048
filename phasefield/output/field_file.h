#pragma once

#include <deal.II/numerics/data_out.h>

#include <filesystem>
#include <vector>

namespace endoflow::phasefield {

/// Writes fields/fields_NNNNNN.vtu (one file for all processes) of `data` and fields.pvd with the times so far;
/// collective.
void write_field_file(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                      MPI_Comm communicator, const dealii::DataOut<2>& data);

}  // namespace endoflow::phasefield
