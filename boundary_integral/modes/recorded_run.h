#pragma once

// The membrane of a finished run of the sharp engine, from its directory.

#include <filesystem>
#include <vector>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

class RecordedRun {
  public:
    /// Throws IoError when the directory holds no run of the sharp engine with shapes.
    explicit RecordedRun(const std::filesystem::path& directory);

    /// Those of the run, with the number of elements that the shapes have.
    [[nodiscard]] const Parameters& parameters() const { return parameters_; }
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  // of the shapes, us

    /// The spline coefficients of a shape: it is stored at eight points per element, more than it has coefficients, so
    /// that they come back to round-off. Throws IoError when the points are not those of such a spline.
    [[nodiscard]] MembraneState state(const MembraneSpace& space, std::size_t index) const;

  private:
    std::filesystem::path shapes_;
    Parameters parameters_;
    std::vector<double> times_;
};

}  // namespace endoflow::boundary_integral
