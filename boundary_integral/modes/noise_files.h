#pragma once

// What `endoflow-modes --noise` writes: noise.csv, noise_modes.csv, noise.h5, noise.json.

#include <filesystem>
#include <optional>
#include <string>

#include "boundary_integral/modes/noise_growth.h"
#include "shared/output/hdf5_file.h"

namespace endoflow::boundary_integral {

class NoiseFiles {
  public:
    NoiseFiles(const std::filesystem::path& directory, const AlongRun& run, double temperature);

    /// The spreads at the time reached.
    void add(const NoiseGrowth& growth);

    void finish(const NoiseGrowth& growth);

  private:
    std::filesystem::path directory_;
    const AlongRun& run_;
    double temperature_;  // K
    Hdf5File shapes_;
    std::size_t count_ = 0;
    std::optional<NoisyShape> at_budding_;
    std::string table_, modes_;
};

}  // namespace endoflow::boundary_integral
