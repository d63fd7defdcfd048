#include "phasefield/evolution/time_loop.h"
#include "phasefield/io/mesh_checkpoint.h"

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
    save_mesh_and_state(output_.directory() / "checkpoint" / slot, discretization_, state_);
    checkpoints_written_ += 1;
    Checkpoint checkpoint;
    checkpoint.time_us = time_;
    checkpoint.texts["mesh"] = slot;
    checkpoint.scalars = {{"nominal_step", control_.nominal},         {"steps_since_doubling", control_.since_doubling},
                          {"bending_energy", last_energy_},           {"moved", moved_},
                          {"shapes_written", shapes_written_},        {"checkpoints_written", checkpoints_written_},
                          {"neck_radius", neck_radius_.value_or(-1)}, {"budding_time", budding_time_.value_or(-1)}};
    checkpoint.arrays["field_times"] = field_times_;
    output_.write_checkpoint(checkpoint);
}

void TimeLoop::restart(const Checkpoint& checkpoint) {
    const auto optional = [&](const char* name) {
        const double value = checkpoint.scalar(name);
        return value < 0 ? std::nullopt : std::optional(value);
    };
    time_ = checkpoint.time_us;
    control_.nominal = checkpoint.scalar("nominal_step");
    control_.since_doubling = checkpoint.scalar("steps_since_doubling");
    last_energy_ = checkpoint.scalar("bending_energy");
    moved_ = checkpoint.scalar("moved");
    shapes_written_ = checkpoint.scalar("shapes_written");
    checkpoints_written_ = checkpoint.scalar("checkpoints_written");
    neck_radius_ = optional("neck_radius");
    budding_time_ = optional("budding_time");
    field_times_ = checkpoint.array("field_times");
    state_ = load_mesh_and_state(output_.directory() / "checkpoint" / checkpoint.text("mesh"), discretization_);
    contour_ = extract_contour(discretization_.spaces, state_, parameters_);
    observables_ = measure(contour_.curve, model_);
}

}  // namespace endoflow::phasefield
