#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace endoflow {

/// One accepted time step. Values that do not exist (no neck) stay empty.
struct HistoryRow {
    double time_us = 0;
    double step_us = 0;
    std::optional<double> neck_radius_nm;
    std::optional<double> bud_diameter_nm;
    double bud_height_nm = 0;
    double membrane_area_nm2 = 0;
    double bending_energy_pN_nm = 0;
    double molecule_mass_nm2 = 0;
    double area_strain_max = 0;
    double volume_extracellular_nm3 = 0;
    double wall_s = 0;
    std::vector<double> extra;  // the engine's own columns, in the order it named them
};

/// Names of the columns all engines share, in file order.
[[nodiscard]] const std::vector<std::string>& common_history_columns();

/// history.csv: one line per accepted step, on the disk before the next step begins.
class HistoryFile {
  public:
    /// Starts a new file. Throws IoError.
    HistoryFile(const std::filesystem::path& file, const std::vector<std::string>& extra_columns);

    /// Continues an existing file after dropping every row later than `last_time_us` and any torn last line.
    /// Throws IoError when the columns differ.
    HistoryFile(const std::filesystem::path& file, const std::vector<std::string>& extra_columns, double last_time_us);

    /// Throws IoError when the row cannot be written, SolverError when a value is not finite.
    void append(const HistoryRow& row);

  private:
    std::filesystem::path path_;
    std::size_t extra_columns_;
    std::ofstream stream_;
};

}  // namespace endoflow
