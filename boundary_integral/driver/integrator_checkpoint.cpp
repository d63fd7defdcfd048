#include "boundary_integral/driver/integrator_checkpoint.h"

#include <vector>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

void save(const StepHistory& history, Checkpoint& checkpoint) {
    checkpoint.time_us = history.time;
    checkpoint.scalars["next_step"] = history.step;
    checkpoint.scalars["order"] = history.order;
    checkpoint.scalars["equal_steps"] = history.equal_steps;
    const Eigen::MatrixXd& differences = history.differences;
    checkpoint.arrays["differences"] = {differences.data(), differences.data() + differences.size()};
}

StepHistory restored_history(const Checkpoint& checkpoint, Eigen::Index size, const std::string& directory) {
    const std::vector<double>& differences = checkpoint.array("differences");
    constexpr Eigen::Index columns = StepHistory::highest_order + 3;
    if (static_cast<Eigen::Index>(differences.size()) != size * columns) {
        throw IoError("the checkpoint in " + directory + " does not hold this membrane; run without --restart");
    }
    StepHistory history;
    history.time = checkpoint.time_us;
    history.step = checkpoint.scalar("next_step");
    history.order = static_cast<int>(checkpoint.scalar("order"));
    history.equal_steps = static_cast<int>(checkpoint.scalar("equal_steps"));
    history.differences = Eigen::Map<const Eigen::MatrixXd>(differences.data(), size, columns);
    return history;
}

}  // namespace endoflow::boundary_integral
