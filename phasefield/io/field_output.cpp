#include "phasefield/io/field_output.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

std::string file_name(std::size_t index) {
    char name[40];
    std::snprintf(name, sizeof name, "fields/fields_%06zu.vtu", index);
    return name;
}

void write_index(const std::filesystem::path& file, const std::vector<double>& times) {
    std::vector<std::pair<double, std::string>> entries;
    for (std::size_t i = 0; i < times.size(); ++i) entries.emplace_back(times[i], file_name(i));
    const auto fresh = file.string() + ".new";
    {
        std::ofstream stream(fresh);
        dealii::DataOutBase::write_pvd_record(stream, entries);
        if (!stream.flush()) throw IoError("cannot write " + fresh);
    }
    std::filesystem::rename(fresh, file);
}

}  // namespace

void write_field_file(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                      MPI_Comm communicator, const dealii::DataOut<2>& data) {
    const bool first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    if (first) std::filesystem::create_directories(run_directory / "fields");
    MPI_Barrier(communicator);
    data.write_vtu_in_parallel((run_directory / file_name(times.size())).string(), communicator);
    times.push_back(time);
    if (first) write_index(run_directory / "fields.pvd", times);
}

void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                  const Spaces& spaces, const State& state) {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    std::vector<Interpretation> meaning(n_flow_components, dealii::DataComponentInterpretation::component_is_scalar);
    meaning[u_r] = meaning[u_z] = dealii::DataComponentInterpretation::component_is_part_of_vector;
    dealii::DataOut<2> data;
    data.add_data_vector(spaces.flow.dofs, state.flow,
                         std::vector<std::string>{"velocity", "velocity", "pressure", "lambda", "phi", "membrane_force",
                                                  "bending_moment"},
                         meaning);
    data.add_data_vector(spaces.molecules.dofs, state.molecules, std::vector<std::string>{"c", "chemical_potential"});
    data.add_data_vector(spaces.stretching.dofs, state.stretching, "stretching");
    data.build_patches(std::max(spaces.flow.degrees[phi], 1u));
    write_field_file(run_directory, times, time, spaces.flow.dofs.get_communicator(), data);
}

}  // namespace endoflow::phasefield
