#include "phasefield/schemes/paper/state_files.h"

#include <deal.II/distributed/solution_transfer.h>

#include <algorithm>
#include <string>

#include "phasefield/checkpoint/mesh_checkpoint.h"
#include "phasefield/output/field_file.h"

namespace endoflow::phasefield::paper {

namespace {

using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;

Vector read(const Space& space) {
    Transfer transfer(space.dofs);
    Vector vector = space.vector();
    transfer.deserialize(vector);
    vector.update_ghost_values();
    return vector;
}

}  // namespace

void save_mesh_and_state(const std::filesystem::path& directory, Discretization& d, const State& state) {
    make_empty_directory(directory, d.communicator);
    Transfer flow(d.spaces.flow.dofs), molecules(d.spaces.molecules.dofs), stretching(d.spaces.stretching.dofs);
    flow.prepare_for_serialization(state.flow);
    molecules.prepare_for_serialization(state.molecules);
    stretching.prepare_for_serialization(state.stretching);
    d.mesh->save((directory / "mesh").string());
    MPI_Barrier(d.communicator);
}

State load_mesh_and_state(const std::filesystem::path& directory, Discretization& d) {
    load_mesh(directory, *d.mesh);
    d.renew();
    State state;
    state.flow = read(d.spaces.flow);
    state.molecules = read(d.spaces.molecules);
    state.stretching = read(d.spaces.stretching);
    return state;
}

void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                  const Spaces& spaces, const State& state, const PaperSchemeParameters& numerics) {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    std::vector<Interpretation> meaning(n_flow_components, dealii::DataComponentInterpretation::component_is_scalar);
    meaning[u_r] = meaning[u_z] = dealii::DataComponentInterpretation::component_is_part_of_vector;
    const std::string bending = numerics.bending_unknown == BendingUnknown::f ? "f" : "bending_moment";
    dealii::DataOut<2> data;
    data.add_data_vector(
        spaces.flow.dofs, state.flow,
        std::vector<std::string>{"velocity", "velocity", "pressure", "lambda", "phi", "membrane_force", bending},
        meaning);
    data.add_data_vector(spaces.molecules.dofs, state.molecules, std::vector<std::string>{"c", "chemical_potential"});
    data.add_data_vector(spaces.stretching.dofs, state.stretching, "stretching");
    data.build_patches(std::max(spaces.flow.degrees[phi], 1u));
    write_field_file(run_directory, times, time, spaces.flow.dofs.get_communicator(), data);
}

}  // namespace endoflow::phasefield::paper
