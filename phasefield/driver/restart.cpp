#include <deal.II/base/exceptions.h>

#include <cstdint>

#include "phasefield/checkpoint/mesh_checkpoint.h"
#include "phasefield/driver/time_loop.h"
#include "shared/output/checkpoint_archive.h"
#include "shared/output/phase_timer.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// Mesh and vectors rotate through this many directories, so that those of the last two records are never overwritten.
constexpr int slots = 3;

std::string slot_name(double count) {
    return "mesh-" + std::to_string(static_cast<long>(count) % slots);
}

}  // namespace

void TimeLoop::checkpoint() {
    const PhaseTimer timer(output_, "checkpoint");
    const std::string slot = slot_name(checkpoints_written_);
    checkpoints_written_ += 1;
    Checkpoint checkpoint;
    checkpoint.time_us = time_;
    checkpoint.texts["mesh"] = slot;
    checkpoint.scalars = {{"energy", last_energy_},
                          {"energy_loss_rate", last_loss_},
                          {"checkpoints_written", checkpoints_written_},
                          {"neck_radius", neck_radius_},
                          {"budded", events_.budded() ? 1 : 0}};
    checkpoint.arrays["field_times"] = field_times_;
    molecules_.serialize(CheckpointWriter(checkpoint));
    const auto directory = output_.directory() / "checkpoint" / slot;
    try {
        scheme_->save(directory, checkpoint);
    } catch (const dealii::ExceptionBase&) {
        throw IoError(directory.string() + ": cannot be written; check the disk's space and permissions");
    }
    require_whole(directory, static_cast<std::uint64_t>(scheme_->cells()));
    checkpoint.texts["mesh_files"] = describe_files(directory);
    output_.write_checkpoint(checkpoint);
}

void TimeLoop::restart(const Checkpoint& checkpoint) {
    time_ = checkpoint.time_us;
    last_energy_ = checkpoint.scalar("energy");
    last_loss_ = checkpoint.scalar("energy_loss_rate");
    checkpoints_written_ = checkpoint.scalar("checkpoints_written");
    neck_radius_ = checkpoint.scalar("neck_radius");
    events_.restore(checkpoint.scalar("budded") != 0);
    field_times_ = checkpoint.array("field_times");
    molecules_.serialize(CheckpointReader(checkpoint));
    const auto directory = output_.directory() / "checkpoint" / checkpoint.text("mesh");
    require_files(directory, checkpoint.text("mesh_files"));
    contour_ = scheme_->load(directory, checkpoint).contour;
    observables_ = measure(contour_.curve, model(time_));
    if (events_.budded() && parameters_.output.stop_at_budding) event_end_ = ExitReason::budded;
    if (contour_.components > 1) event_end_ = ExitReason::neck_closed;
}

}  // namespace endoflow::phasefield
