#include "summary.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "shared/support/error.h"

namespace endoflow::cli {

namespace {

using Json = nlohmann::ordered_json;

Json read_record(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw IoError(file.string() + ": cannot be read; give the directory of a run");
    try {
        return Json::parse(stream);
    } catch (const Json::exception& failure) {
        throw IoError(fmt::format("{}: damaged run record: {}", file.string(), failure.what()));
    }
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result(1);
    for (const char c : line) {
        if (c == ',')
            result.emplace_back();
        else
            result.back() += c;
    }
    return result;
}

/// The last complete row of history.csv as "name  value" lines.
std::string last_row(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw IoError(file.string() + ": cannot be read");
    std::string header, line, last;
    std::getline(stream, header);
    while (std::getline(stream, line))
        if (!stream.eof()) last = line;
    const auto names = cells(header), values = cells(last);
    if (last.empty() || names.size() != values.size()) return "  no step was recorded\n";
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("  {:<36} {}\n", names[i], values[i].empty() ? "-" : values[i]);
    return text;
}

/// How far the quantity of an alarm went in the whole run.
double largest(const Json& record, const Json& alarm) {
    return record.at("accuracy").at(alarm.at("name").get<std::string>()).at("largest").get<double>();
}

std::string describe(const Json& record, const std::filesystem::path& directory) {
    const auto& steps = record.at("steps");
    const auto& reason = record.at("exit_reason");
    std::string text = fmt::format("{}: case '{}', {} engine\n", directory.string(),
                                   record.at("parameters").at("case").at("name").get<std::string>(),
                                   record.at("engine").get<std::string>());
    text += fmt::format("  {} ({}), t = {:.6g} of {:g} µs\n", record.at("state").get<std::string>(),
                        reason.is_string() ? reason.get<std::string>() : "no exit reason yet",
                        record.at("time_us").get<double>(), record.at("parameters").at("time").at("end").get<double>());
    text += fmt::format("  {} steps, {} rejected; {:.1f} s wall, {:.1f} s CPU, {} process(es); version {} ({})\n",
                        steps.at("accepted").get<long>(), steps.at("rejected").get<long>(),
                        record.at("wall_s").get<double>(), record.at("cpu_s").get<double>(),
                        record.at("processes").get<int>(), record.at("provenance").at("version").get<std::string>(),
                        record.at("provenance").at("git").get<std::string>());
    for (const auto& [name, event] : record.at("events").items())
        text += fmt::format("  event: {} at t = {:.8g} µs\n", name, event.at("time_us").get<double>());
    for (const auto& alarm : record.value("alarms", Json::array()))
        text += fmt::format("  alarm: {} at t = {:.4g} µs: {}: {:.2g}, allowed {:g}; {}\n",
                            alarm.at("name").get<std::string>(), alarm.at("time_us").get<double>(),
                            alarm.at("meaning").get<std::string>(), largest(record, alarm),
                            alarm.at("bound").get<double>(), alarm.at("remedy").get<std::string>());
    return text;
}

}  // namespace

std::string summarize_run(const std::filesystem::path& directory) {
    const auto file = directory / "run.json";
    const Json record = read_record(file);
    try {
        return describe(record, directory) + "last step:\n" + last_row(directory / "history.csv");
    } catch (const Json::exception& failure) {
        throw IoError(fmt::format("{}: not a complete run record: {}", file.string(), failure.what()));
    }
}

}  // namespace endoflow::cli
