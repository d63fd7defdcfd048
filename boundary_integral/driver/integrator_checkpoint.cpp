#include "boundary_integral/driver/integrator_checkpoint.h"

#include <vector>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

void save(const StartingPoint& start, Checkpoint& checkpoint) {
    checkpoint.time_us = start.time;
    checkpoint.scalars["first_step"] = start.step;
    checkpoint.arrays["unknowns"] = {start.y.data(), start.y.data() + start.y.size()};
}

StartingPoint restored_start(const Checkpoint& checkpoint, Eigen::Index size, const std::string& directory) {
    const std::vector<double>& unknowns = checkpoint.array("unknowns");
    if (static_cast<Eigen::Index>(unknowns.size()) != size)
        throw IoError("the checkpoint in " + directory + " does not hold this membrane; run without --restart");
    return {checkpoint.time_us, checkpoint.scalar("first_step"),
            Eigen::Map<const Eigen::VectorXd>(unknowns.data(), size)};
}

}  // namespace endoflow::boundary_integral
