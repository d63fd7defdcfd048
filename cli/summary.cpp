#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/model/bending_model.h"
#include "shared/output/accuracy.h"
#include "shared/output/history_file.h"
#include "shared/output/run_lock.h"
#include "shared/output/run_record.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"

namespace endoflow::cli {

namespace {

/// A column's name as words, and its unit: "membrane_area_nm2" is {"membrane area", "nm²"}.
std::pair<std::string, std::string> words_and_unit(std::string column) {
    static const std::vector<std::pair<std::string, std::string>> units{{"_pN_nm_per_us", "pN nm/µs"},
                                                                        {"_nm3_per_us", "nm³/µs"},
                                                                        {"_pN_per_nm", "pN/nm"},
                                                                        {"_nm_per_us", "nm/µs"},
                                                                        {"_per_nm", "1/nm"},
                                                                        {"_pN_nm", "pN nm"},
                                                                        {"_nm3", "nm³"},
                                                                        {"_nm2", "nm²"},
                                                                        {"_nm", "nm"},
                                                                        {"_us", "µs"},
                                                                        {"_pN", "pN"},
                                                                        {"_s", "s"}};
    const auto unit = std::find_if(units.begin(), units.end(),
                                   [&](const auto& known) { return std::string_view(column).ends_with(known.first); });
    if (unit != units.end()) column.resize(column.size() - unit->first.size());
    std::replace(column.begin(), column.end(), '_', ' ');
    return {column, unit == units.end() ? "" : unit->second};
}

/// Five significant digits; counts, and what has more digits before the point, as whole numbers.
std::string rounded(double value) {
    constexpr double least_with_more_digits = 1e5, most = 1e15;
    const bool whole = value == std::floor(value) || std::abs(value) >= least_with_more_digits;
    return whole && std::abs(value) < most ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

/// The last complete row of history.csv as "name  value unit" lines; stationary shapes have no time.
std::string last_row(const RunDirectory& directory, bool has_time) {
    const History history = read_history(directory.history());
    if (history.rows.empty()) return "  no step was recorded\n";
    std::string text;
    for (std::size_t i = 0; i < history.columns.size(); ++i) {
        const std::string& column = history.columns[i];
        if (!has_time && (column == "time_us" || column == "step_us")) continue;
        const auto [words, unit] = words_and_unit(column);
        const std::optional<double> value = history.rows.back()[i];
        text += fmt::format("  {:<30} {}{}{}\n", words, value ? rounded(*value) : "-",
                            value && !unit.empty() ? " " : "", value ? unit : "");
    }
    return text;
}

/// How far a run came; a branch of stationary shapes counts its shapes where a run has its time.
std::string reached(const RunRecord& record) {
    if (record.at("engine") != "statics")
        return fmt::format("t = {:.6g} of {:g} µs", record.at("time_us").get<double>(),
                           record.at("parameters").at("time").at("end").get<double>());
    if (!record.at("notes").contains("branch")) return "one stationary shape";
    const RunRecord& branch = record.at("notes").at("branch");
    return fmt::format("{} stationary shapes, {} from {:g} to {:.6g}", branch.at("points").get<long>(),
                       branch.at("parameter").get<std::string>(), branch.at("begin").get<double>(),
                       branch.at("end").get<double>());
}

/// β and C of the bare and the coated membrane, which the convention makes of b and H0.
std::string bending(const RunRecord& recorded) {
    Parameters parameters;
    for (const ParameterRow& row : parameter_table()) {
        if (row.section != "membrane" || !recorded.contains(row.key)) continue;
        const RunRecord& value = recorded.at(row.key);
        const std::string where = "run.json";
        if (value.is_string())
            set_parameter(parameters, row, value.get<std::string>(), where);
        else if (value.is_boolean())
            set_parameter(parameters, row, value.get<bool>(), where);
        else if (value.is_array())
            set_parameter(parameters, row, value.get<std::array<double, 2>>(), where);
        else
            set_parameter(parameters, row, value.get<double>(), where);
    }
    const BendingModel model(parameters.membrane);
    return fmt::format("β(0) = {:g}, β(1) = {:g} pN nm, C(1) = {:.5g} 1/nm", model.stiffness(0).value,
                       model.stiffness(1).value, model.spontaneous_curvature(1).value);
}

/// What the numbers rest on: conventions and resolution.
std::string basis(const RunRecord& record) {
    const RunRecord& membrane = record.at("parameters").at("membrane");
    return fmt::format("  curvature convention {}: {}; {}\n", membrane.at("curvature_convention").get<std::string>(),
                       bending(membrane), resolution_in_words(record));
}

/// Value ± error of what `--certify` looked at.
std::string certified(const RunRecord& record) {
    if (!record.contains("certificate")) return "";
    std::string text;
    for (const auto& [name, entry] : record.at("certificate").at("values").items())
        if (entry.contains("in_words"))
            text += fmt::format("  certified: {} {}\n", entry.at("title").get<std::string>(),
                                entry.at("in_words").get<std::string>());
    return text;
}

/// One line for each quantity that left the bounds of an accurate run.
std::string alarms(const RunRecord& record) {
    if (!record.contains("alarms")) return "";
    std::string text;
    for (const RunRecord& entry : record.at("alarms")) {
        Alarm alarm = alarm_of(entry);
        alarm.value = record.at("accuracy").at(alarm.name).at("largest").get<double>();  // of the whole run
        text += fmt::format("  alarm: {}\n", alarm.describe());
    }
    return text.empty() ? "  no alarms: every balance stayed within its bound\n" : text;
}

/// Whether the run works, how it ended, or what to do about one that was killed.
std::string state(const RunRecord& record, const RunDirectory& directory) {
    const auto state = record.at("state").get<std::string>();
    const auto& reason = record.at("exit_reason");
    if (state == "killed") {
        const bool continues = record.at("engine") != "statics" && directory.holds_checkpoint();
        return "killed, no longer running; " +
               std::string(continues ? "continue with --restart" : "run it again, it left no checkpoint");
    }
    return fmt::format("{} ({})", state, reason.is_string() ? reason.get<std::string>() : "no exit reason yet");
}

std::string describe(const RunRecord& record, const RunDirectory& directory) {
    const auto& steps = record.at("steps");
    std::string text = fmt::format("{}: case '{}', {} engine\n", one_line(directory.root.string()),
                                   record.at("parameters").at("case").at("name").get<std::string>(),
                                   record.at("engine").get<std::string>());
    text += fmt::format("  {}, {}\n", state(record, directory), reached(record));
    text += fmt::format("  {} steps, {} rejected; {:.1f} s wall, {:.1f} s CPU, {} process(es); version {} ({})\n",
                        steps.at("accepted").get<long>(), steps.at("rejected").get<long>(),
                        record.at("wall_s").get<double>(), record.at("cpu_s").get<double>(),
                        record.at("processes").get<int>(), record.at("provenance").at("version").get<std::string>(),
                        record.at("provenance").at("git").get<std::string>());
    text += basis(record);
    for (const auto& [name, event] : record.at("events").items())
        text += fmt::format("  event: {} at t = {:.5g} µs\n", name, event.at("time_us").get<double>());
    return text + certified(record) + alarms(record);
}

}  // namespace

std::string summarize_run(const std::filesystem::path& root) {
    const RunDirectory directory{root};
    const RunRecord record = read_current_record(directory);
    try {
        const bool moves = record.at("engine") != "statics";
        return describe(record, directory) + (moves ? "last step:\n" : "last shape:\n") + last_row(directory, moves);
    } catch (const RunRecord::exception& failure) {
        throw IoError(fmt::format("{}: not a complete run record: {}", directory.record().string(), failure.what()));
    }
}

}  // namespace endoflow::cli
