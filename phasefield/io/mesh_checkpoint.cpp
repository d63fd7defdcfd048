#include "phasefield/io/mesh_checkpoint.h"

#include <deal.II/distributed/solution_transfer.h>

#include "shared/support/error.h"

namespace endoflow::phasefield {

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

void make_empty_directory(const std::filesystem::path& directory, MPI_Comm communicator) {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0) {
        std::filesystem::remove_all(directory);
        std::filesystem::create_directories(directory);
    }
    MPI_Barrier(communicator);
}

void load_mesh(const std::filesystem::path& directory, Mesh& mesh) {
    if (!std::filesystem::exists(directory / "mesh.info"))
        throw IoError("checkpoint " + directory.string() + " holds no mesh; start the run afresh");
    mesh.load((directory / "mesh").string());
}

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

}  // namespace endoflow::phasefield
