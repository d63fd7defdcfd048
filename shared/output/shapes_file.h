#pragma once

#include <filesystem>

#include "shared/geometry/membrane_curve.h"

namespace endoflow {

/// shapes.h5: /shapes/NNNNNN with s, r, z, c, lambda, kappa, u_r, u_z and the time as attribute, units as attributes.
class ShapesFile {
  public:
    /// Starts a new file. Throws IoError.
    explicit ShapesFile(const std::filesystem::path& file);

    /// Continues an existing file after dropping every shape later than `last_time_us`. Throws IoError.
    ShapesFile(const std::filesystem::path& file, double last_time_us);

    /// Throws IoError when it cannot be written, SolverError when a value is not finite.
    void append(double time_us, const MembraneCurve& curve);

    [[nodiscard]] int count() const { return count_; }

  private:
    std::filesystem::path path_;
    int count_ = 0;
};

}  // namespace endoflow
