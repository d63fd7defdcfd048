#pragma once

// A finished run of the sharp engine, from its directory.

#include <filesystem>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

struct RecordedShape {
    std::vector<double> r, z;  // nm, from the axis
};

class RecordedRun {
  public:
    /// Throws IoError when the directory holds no run of the sharp engine with shapes, InputError when the linearised
    /// model does not contain what the run's membrane does.
    explicit RecordedRun(const std::filesystem::path& directory);

    /// Those of the run, with the largest number of elements that its shapes have.
    [[nodiscard]] const Parameters& parameters() const { return parameters_; }
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  // of the shapes, us
    [[nodiscard]] RecordedShape shape(std::size_t index) const;

  private:
    std::filesystem::path shapes_;
    Parameters parameters_;
    std::vector<double> times_;
};

}  // namespace endoflow::boundary_integral
