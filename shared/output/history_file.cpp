#include "shared/output/history_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "shared/output/atomic_file.h"
#include "shared/output/output_plan.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

constexpr std::uintmax_t largest_history = std::uintmax_t{1} << 32;

std::string number(double value, const std::string& what) {
    if (!std::isfinite(value))
        throw SolverError("not-finite", fmt::format("{} became {}", what, value),
                          "the step that led here should have been rejected: lower time.tolerance or time.max_step");
    return fmt::format("{:.15g}", value);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

/// The values of a row; empty when the row is damaged: another number of cells, cells that are not numbers, no time.
std::optional<std::vector<std::optional<double>>> values_of_row(const std::string& line, std::size_t count) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != count || cells.front().empty()) return std::nullopt;
    std::vector<std::optional<double>> values;
    for (const std::string& cell : cells) {
        char* end = nullptr;
        const double value = std::strtod(cell.c_str(), &end);
        if (end != cell.c_str() + cell.size() || !std::isfinite(value)) return std::nullopt;
        values.push_back(cell.empty() ? std::nullopt : std::optional(value));
    }
    return values;
}

/// Calls take(line, values) for the intact rows; returns the header.
template <class Take>
std::string each_row(const std::filesystem::path& file, const Take& take) {
    std::istringstream lines(read_file(file, largest_history));
    std::string first, line;
    std::getline(lines, first);
    const std::size_t count = cells_of(first).size();
    while (std::getline(lines, line) && !lines.eof()) {  // at the end of the file: a row without its end
        const auto values = values_of_row(line, count);
        if (!values) break;
        take(line, *values);
    }
    return first;
}

}  // namespace

std::string history_header(const std::vector<ColumnText>& own_columns) {
    std::string text;
    for (const ColumnText& column : all_columns(own_columns)) text += (text.empty() ? "" : ",") + column.name;
    return text;
}

std::string history_line(const HistoryRow& row, std::size_t own_columns) {
    if (row.extra.size() != own_columns)
        throw std::logic_error("a history row must have one value for each of the engine's own columns");
    std::string line;
    for (const auto& column : common_history_columns()) {
        if (!line.empty()) line += ",";
        if (const auto value = column.value(row)) line += number(*value, column.name);
    }
    for (const auto& value : row.extra) line += value ? "," + number(*value, "a column of history.csv") : ",";
    return line;
}

HistoryFile::HistoryFile(const std::filesystem::path& file, const std::vector<ColumnText>& own_columns)
    : path_(file), own_columns_(own_columns.size()) {
    write_file_atomically(file, history_header(own_columns) + "\n");
    stream_.open(file, std::ios::app);
}

History read_history(const std::filesystem::path& file) {
    History history;
    history.columns = cells_of(each_row(
        file, [&](const std::string&, const std::vector<std::optional<double>>& row) { history.rows.push_back(row); }));
    return history;
}

KeptHistory read_kept_history(const std::filesystem::path& file, const std::vector<ColumnText>& own_columns,
                              double last_time_us, std::optional<long> expected_rows) {
    KeptHistory kept;
    const std::string first =
        each_row(file, [&](const std::string& line, const std::vector<std::optional<double>>& row) {
            kept.reached = *row.front();
            if (later(kept.reached, last_time_us)) return;
            kept.text += line + "\n";
            kept.times.push_back(kept.reached);
        });
    if (first != history_header(own_columns))
        throw IoError(file.string() + ": its columns are not those of this engine; run without --restart");
    kept.text = first + "\n" + kept.text;
    if (const auto rows = static_cast<long>(kept.times.size()); expected_rows && rows != *expected_rows)
        throw IoError(
            fmt::format("{}: {} intact rows up to t = {} µs, but the run had written {} when it made its "
                        "checkpoint; restore the file or run without --restart",
                        file.string(), rows, last_time_us, *expected_rows));
    return kept;
}

HistoryFile::HistoryFile(const std::filesystem::path& file, const std::vector<ColumnText>& own_columns,
                         KeptHistory kept)
    : path_(file), own_columns_(own_columns.size()), times_(std::move(kept.times)) {
    write_file_atomically(file, kept.text);
    stream_.open(file, std::ios::app);
}

void HistoryFile::append(const HistoryRow& row) {
    stream_ << history_line(row, own_columns_) << '\n' << std::flush;
    if (!stream_) throw IoError(path_.string() + ": a row cannot be written; check the disk's space and permissions");
    times_.push_back(row.time_us);
}

long HistoryFile::rows_until(double time_us) const {
    return std::count_if(times_.begin(), times_.end(), [&](double time) { return !later(time, time_us); });
}

}  // namespace endoflow
