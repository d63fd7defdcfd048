#include "phasefield/checkpoint/mesh_checkpoint.h"
#include "phasefield/fem/mesh_transfer.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "shared/output/checkpoint_archive.h"

namespace endoflow::phasefield::production {

void ProductionScheme::save(const std::filesystem::path& directory, Checkpoint& checkpoint) {
    ThicknessCurve curve = state_.thickness ? state_.thickness->curve() : ThicknessCurve();
    const CheckpointWriter writer(checkpoint);
    state_.serialize(writer, curve);
    writer("collar_place", case_.loads.collar_place);
    solver_.serialize(writer);
    make_empty_directory(directory, mesh_->get_communicator());
    const auto transfer = MeshTransfer::for_saving(space_, state_.solutions);
    if (bulk_) bulk_->save(checkpoint);
    mesh_->save((directory / "mesh").string());
    MPI_Barrier(mesh_->get_communicator());
}

StepOutcome ProductionScheme::load(const std::filesystem::path& directory, const Checkpoint& checkpoint) {
    ThicknessCurve curve;
    const CheckpointReader reader(checkpoint);
    state_.serialize(reader, curve);
    reader("collar_place", case_.loads.collar_place);
    solver_.serialize(reader);
    load_mesh(directory, *mesh_);
    distribute();
    state_.thickness = thickness_on(*mesh_, std::move(curve));
    state_.solutions = MeshTransfer::loaded(space_, state_.times.size());
    if (bulk_) bulk_->load(checkpoint);
    StepOutcome out = present();
    solver_.reinit(space_, state_.membrane);
    return out;
}

}  // namespace endoflow::phasefield::production
