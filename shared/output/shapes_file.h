#pragma once

#include <filesystem>

#include "shared/geometry/membrane_curve.h"

namespace endoflow {

/// How many shapes not later than this a shapes.h5 holds, all of them read to the end; changes nothing. Throws IoError
/// when one of them is damaged.
[[nodiscard]] int count_shapes(const std::filesystem::path& file, double last_time_us);

/// shapes.h5: /shapes/NNNNNN with s, r, z, c, lambda, kappa, u_r, u_z and the time as attribute, units as attributes.
class ShapesFile {
  public:
    /// Starts a new file. Throws IoError.
    explicit ShapesFile(const std::filesystem::path& file);

    /// Continues an existing file after dropping every shape later than `last_time_us`. Throws IoError.
    ShapesFile(const std::filesystem::path& file, double last_time_us);

    /// Throws IoError when it cannot be written, SolverError when a value is not finite.
    void append(double time_us, const MembraneCurve& curve);

    [[nodiscard]] int count() const { return static_cast<int>(times_.size()); }
    /// How many shapes are not later than this.
    [[nodiscard]] int count_until(double time_us) const;

  private:
    std::filesystem::path path_;
    std::vector<double> times_;  // of the shapes in the file, µs
};

}  // namespace endoflow
