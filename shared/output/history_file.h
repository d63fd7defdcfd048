#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "shared/output/history_columns.h"

namespace endoflow {

/// The columns of a history.csv and its rows up to the first torn or damaged one; cells of what does not exist are
/// empty.
struct History {
    std::vector<std::string> columns;
    std::vector<std::vector<std::optional<double>>> rows;
};

/// Throws IoError when the file cannot be read.
[[nodiscard]] History read_history(const std::filesystem::path& file);

/// What a restart keeps of a history.csv: the rows up to its time and up to the first torn or damaged one.
struct KeptHistory {
    std::string text;           // the header and the rows
    std::vector<double> times;  // of the rows, µs
    double reached = 0;         // time of the last intact row in the file, kept or not, µs
};

/// Reads what a restart from `last_time_us` keeps and changes nothing. Throws IoError when the columns differ or the
/// rows are not `expected_rows` in number.
[[nodiscard]] KeptHistory read_kept_history(const std::filesystem::path& file,
                                            const std::vector<ColumnText>& own_columns, double last_time_us,
                                            std::optional<long> expected_rows = {});

/// The first line of a history.csv, without its end.
[[nodiscard]] std::string history_header(const std::vector<ColumnText>& own_columns);
/// A row's line. Throws SolverError when a value is not finite.
[[nodiscard]] std::string history_line(const HistoryRow& row, std::size_t own_columns);

/// history.csv: one line per accepted step, on the disk before the next step begins.
class HistoryFile {
  public:
    /// Starts a new file. Throws IoError.
    HistoryFile(const std::filesystem::path& file, const std::vector<ColumnText>& own_columns);

    /// Continues an existing file, of which only this is kept. Throws IoError.
    HistoryFile(const std::filesystem::path& file, const std::vector<ColumnText>& own_columns, KeptHistory kept);

    /// Throws IoError when the row cannot be written, SolverError when a value is not finite.
    void append(const HistoryRow& row);

    [[nodiscard]] long rows() const { return static_cast<long>(times_.size()); }
    /// How many rows are not later than this.
    [[nodiscard]] long rows_until(double time_us) const;

  private:
    std::filesystem::path path_;
    std::size_t own_columns_;
    std::vector<double> times_;  // of the rows in the file, us
    std::ofstream stream_;
};

}  // namespace endoflow
