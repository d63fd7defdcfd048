#pragma once

// What `endoflow-modes` writes: modes.csv, perturbations.csv, eigenshapes.h5.

#include <filesystem>
#include <string>

#include "boundary_integral/modes/perturbation_growth.h"
#include "shared/output/hdf5_file.h"

namespace endoflow::boundary_integral {

/// r, z, normal_r, normal_z and c at the meridian's points, into a group.
void write_meridian(Hdf5File& file, const std::string& group, const AlongRun& run, const Moment& moment);

class ModeFiles {
  public:
    ModeFiles(const std::filesystem::path& directory, const AlongRun& run);

    /// Rates, eigenshapes and perturbations at the time reached. Returns the largest growth rate of each mode, 1/us.
    std::vector<double> add(const PerturbationGrowth& growth);

    void finish();

  private:
    std::filesystem::path directory_;
    const AlongRun& run_;
    std::vector<double> points_;
    Hdf5File shapes_;
    std::size_t count_ = 0;
    std::string group_;  // of the time
    std::string rates_ = "time_us,mode,rank,growth_per_us,frequency_rad_per_us,peak_r_nm,peak_z_nm\n";
    std::string perturbations_ = "time_us,mode,initial,peak_nm,rms_nm,gain\n";

    void write(const std::string& name, const Eigen::VectorXd& column);
    double write_mode(int mode, const Moment& moment, const ModeRates& rates);
    void write_perturbations(int mode, const PerturbationGrowth& growth);
};

}  // namespace endoflow::boundary_integral
