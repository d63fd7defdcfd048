#include "shared/output/history_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "shared/output/atomic_file.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

constexpr std::uintmax_t largest_history = std::uintmax_t{1} << 32;

std::string header(const std::vector<std::string>& extra_columns) {
    std::string text;
    for (const auto& column : common_history_columns()) text += (text.empty() ? "" : ",") + column.name;
    for (const auto& name : extra_columns) text += "," + name;
    return text;
}

std::string number(double value, const std::string& what) {
    if (!std::isfinite(value))
        throw SolverError("not-finite", fmt::format("{} became {}", what, value),
                          "the step that led here should have been rejected: lower time.tolerance or time.max_step");
    return fmt::format("{:.15g}", value);
}

bool not_later(double time_us, double last_time_us) {
    return time_us <= last_time_us * (1 + 1e-12);
}

/// The time of a row; empty when the row is damaged: another number of cells, or cells that are not numbers.
std::optional<double> time_of_row(const std::string& line, std::ptrdiff_t cells) {
    if (std::count(line.begin(), line.end(), ',') + 1 != cells) return std::nullopt;
    std::istringstream stream(line);
    std::optional<double> time;
    for (std::string cell; std::getline(stream, cell, ',');) {
        if (cell.empty()) continue;
        char* end = nullptr;
        const double value = std::strtod(cell.c_str(), &end);
        if (end != cell.c_str() + cell.size() || !std::isfinite(value)) return std::nullopt;
        if (!time) time = value;
    }
    return line.starts_with(',') ? std::nullopt : time;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& file, const std::vector<std::string>& extra_columns)
    : path_(file), extra_columns_(extra_columns.size()) {
    write_file_atomically(file, header(extra_columns) + "\n");
    stream_.open(file, std::ios::app);
}

KeptHistory read_kept_history(const std::filesystem::path& file, const std::vector<std::string>& extra_columns,
                              double last_time_us, std::optional<long> expected_rows) {
    const std::string content = read_file(file, largest_history);
    if (content.substr(0, content.find('\n')) != header(extra_columns))
        throw IoError(file.string() + ": its columns are not those of this engine; run without --restart");
    std::istringstream lines(content);
    std::string line;
    std::getline(lines, line);
    const std::ptrdiff_t cells = std::count(line.begin(), line.end(), ',') + 1;
    KeptHistory kept;
    kept.text = line + "\n";
    while (std::getline(lines, line) && !lines.eof()) {  // at the end of the file: a row without its end
        const auto time = time_of_row(line, cells);
        if (!time) break;
        kept.reached = *time;
        if (!not_later(*time, last_time_us)) continue;
        kept.text += line + "\n";
        kept.times.push_back(*time);
    }
    if (const auto rows = static_cast<long>(kept.times.size()); expected_rows && rows != *expected_rows)
        throw IoError(
            fmt::format("{}: {} intact rows up to t = {} µs, but the run had written {} when it made its "
                        "checkpoint; restore the file or run without --restart",
                        file.string(), rows, last_time_us, *expected_rows));
    return kept;
}

HistoryFile::HistoryFile(const std::filesystem::path& file, const std::vector<std::string>& extra_columns,
                         KeptHistory kept)
    : path_(file), extra_columns_(extra_columns.size()), times_(std::move(kept.times)) {
    write_file_atomically(file, kept.text);
    stream_.open(file, std::ios::app);
}

void HistoryFile::append(const HistoryRow& row) {
    if (row.extra.size() != extra_columns_)
        throw std::logic_error("a history row must have one value for each of the engine's own columns");
    std::string line;
    for (const auto& column : common_history_columns()) {
        if (!line.empty()) line += ",";
        if (const auto value = column.value_in(row)) line += number(*value, column.name);
    }
    for (const double value : row.extra) line += "," + number(value, "a column of history.csv");
    stream_ << line << '\n' << std::flush;
    if (!stream_) throw IoError(path_.string() + ": a row cannot be written; check the disk's space and permissions");
    times_.push_back(row.time_us);
}

long HistoryFile::rows_until(double time_us) const {
    return std::count_if(times_.begin(), times_.end(), [&](double time) { return not_later(time, time_us); });
}

}  // namespace endoflow
