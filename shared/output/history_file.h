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

    /// Continues an existing file: its rows up to `last_time_us` and up to the first torn or damaged one, no others.
    /// Throws IoError, and leaves the file alone, when the columns differ or these are not `expected_rows` rows.
    HistoryFile(const std::filesystem::path& file, const std::vector<std::string>& extra_columns, double last_time_us,
                std::optional<long> expected_rows = {});

    /// Throws IoError when the row cannot be written, SolverError when a value is not finite.
    void append(const HistoryRow& row);

    [[nodiscard]] long rows() const { return static_cast<long>(times_.size()); }
    /// How many rows are not later than this.
    [[nodiscard]] long rows_until(double time_us) const;

  private:
    std::filesystem::path path_;
    std::size_t extra_columns_;
    std::vector<double> times_;  // of the rows in the file, us
    std::ofstream stream_;
};

}  // namespace endoflow
