#include "shared/output/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "shared/output/atomic_file.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow {

namespace {

/// "boundary-integral" for keys in [boundary_integral] and its subsections: no other engine reads them.
std::string only_reader(const ParameterRow& row) {
    std::string name = row.section.substr(0, row.section.find('.'));
    if (name != "boundary_integral" && name != "phase_field") return "";
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

nlohmann::ordered_json as_json(const ParameterRow& row, const Parameters& parameters) {
    return std::visit([](const auto& value) { return nlohmann::ordered_json(value); }, row.get(parameters));
}

/// A record of a version that did not know the parameter ran with what is its default now.
nlohmann::ordered_json recorded(const RunRecord& record, const ParameterRow& row) {
    const auto* value = find_value(record.at("parameters"), row);
    return value == nullptr ? as_json(row, Parameters{}) : *value;
}

}  // namespace

std::string to_string(ExitReason reason) {
    switch (reason) {
        case ExitReason::done:
            return "done";
        case ExitReason::budded:
            return "budded";
        case ExitReason::neck_closed:
            return "neck-closed";
        case ExitReason::interrupted:
            return "interrupted";
    }
    return "unknown";
}

std::string way_on(ExitReason reason, const EngineIdentity& engine, const Parameters& parameters,
                   double checkpoint_us) {
    if (engine.row_order != RowOrder::in_time) return "";
    constexpr const char* restart = "; continue with --restart";
    switch (reason) {
        case ExitReason::done:
            return restart;
        case ExitReason::budded:
            return std::string(restart) + " and output.stop_at_budding = false";
        case ExitReason::neck_closed:
            if (engine.name != "boundary-integral") return "";
            return fmt::format("{} and a boundary_integral.neck_closed_radius below {:g} nm", restart,
                               parameters.boundary_integral.neck_closed_radius);
        case ExitReason::interrupted:
            return fmt::format("{}, which goes on from t = {:.6g} µs", restart, checkpoint_us);
    }
    return "";
}

RunRecord new_record(const Parameters& parameters, const EngineIdentity& engine) {
    RunRecord record;
    record["format"] = "endoflow run";
    record["format_version"] = 1;
    record["engine"] = engine.name;
    record["state"] = "running";
    record["exit_reason"] = nullptr;
    record["parameters"] = parameters_to_json(parameters);
    record["provenance"] = provenance(engine.libraries);
    record["processes"] = engine.processes;
    record["threads"] = engine.threads;
    record["started"] = utc_now();
    record["ended"] = nullptr;
    record["restarts"] = 0;
    record["segments"] = RunRecord::array();
    record["time_us"] = 0.0;
    record["steps"] = {{"accepted", 0}, {"rejected", 0}};
    record["wall_s"] = 0.0;
    record["cpu_s"] = 0.0;
    record["phases"] = RunRecord::object();
    record["columns"] = RunRecord::object();
    for (const ColumnText& column : all_columns(engine.history_columns))
        record["columns"][column.name] = column.meaning;
    record["events"] = RunRecord::object();
    record["resolution"] = "";
    record["accuracy"] = RunRecord::object();
    record["alarms"] = RunRecord::array();
    record["notes"] = RunRecord::object();
    begin_segment(record, parameters, engine, 0);
    return record;
}

RunRecord parse_record(const std::string& text, const std::string& source) {
    try {
        RunRecord record = RunRecord::parse(text);
        if (record.at("format") != "endoflow run") throw IoError(source + ": not a run record of endoflow");
        return record;
    } catch (const RunRecord::exception& failure) {
        throw IoError(fmt::format("{}: damaged run record: {}", source, failure.what()));
    }
}

RunRecord read_record(const RunDirectory& directory) {
    return parse_record(read_file(directory.record(), largest_record), directory.record().string());
}

void overwrite_state(const RunDirectory& directory, const std::string& state) {
    const std::filesystem::path file = directory.record();
    const std::string running = "\"running\"", text = read_file(file, largest_record);
    const auto place = text.find(running, text.find("\"state\""));
    std::string word = "\"" + state + "\"";
    if (place == std::string::npos || word.size() > running.size()) return;
    word.resize(running.size(), ' ');
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(place));
    stream << word << std::flush;
}

void require_continuable(const RunRecord& record, const Parameters& parameters, const EngineIdentity& engine,
                         const std::string& source) {
    if (record.at("engine") != engine.name)
        throw IoError(fmt::format("{}: was written by the {} engine, not by {}; run without --restart", source,
                                  record.at("engine").get<std::string>(), engine.name));
    for (const ParameterRow& row : parameter_table()) {
        const std::string reader = only_reader(row);
        if (row.free_on_restart || (!reader.empty() && reader != engine.name)) continue;
        const auto before = recorded(record, row), now = as_json(row, parameters);
        if (before != now)
            throw InputError(
                fmt::format("{} = {}: the run to continue has {}, which a restart cannot change; keep it, or start "
                            "another run",
                            row.name(), now.dump(), before.dump()));
    }
}

void begin_segment(RunRecord& record, const Parameters& parameters, const EngineIdentity& engine, double begin_us) {
    RunRecord segment = {{"begin_us", begin_us},      {"started", utc_now()},
                         {"version", version()},      {"git", git_description()},
                         {"host", host_name()},       {"processes", engine.processes},
                         {"threads", engine.threads}, {"parameters", RunRecord::object()}};
    for (const ParameterRow& row : parameter_table())
        if (row.free_on_restart) segment["parameters"][row.name()] = as_json(row, parameters);
    record["segments"].push_back(std::move(segment));
    record["parameters"] = parameters_to_json(parameters);
    record["processes"] = engine.processes;
    record["threads"] = engine.threads;
}

bool add_event(RunRecord& record, const std::string& name, double time_us, const ShapeMeasures& shape) {
    if (record["events"].contains(name)) return false;
    RunRecord event = {{"time_us", time_us}};
    for (const auto& [key, value] : shape_values(shape)) event[key] = value ? RunRecord(*value) : RunRecord();
    record["events"][name] = event;
    return true;
}

void add_rejected_step(RunRecord& record) {
    auto& rejected = record["steps"]["rejected"];
    rejected = rejected.get<long>() + 1;
}

void add_phase_time(RunRecord& record, const std::string& phase, double wall_s, double cpu_s) {
    auto& totals = record["phases"][phase];
    if (totals.is_null()) totals = {{"wall_s", 0.0}, {"cpu_s", 0.0}};
    totals["wall_s"] = totals["wall_s"].get<double>() + wall_s;
    totals["cpu_s"] = totals["cpu_s"].get<double>() + cpu_s;
}

std::string resolution_in_words(const RunRecord& record) {
    const RunRecord &parameters = record.at("parameters"), &notes = record.at("notes");
    if (record.at("engine") == "phase-field") {
        const RunRecord& own = parameters.at("phase_field");
        const double cells = notes.value("cell_size_nm", own.at("cell_size").get<double>());
        return fmt::format("layer of ε = {:g} nm", own.at("epsilon").get<double>()) +
               (cells > 0 ? fmt::format(" on cells of {:.4g} nm", cells) : "");
    }
    const RunRecord& own = parameters.at("boundary_integral");
    const long elements = notes.value("elements", own.at("elements").get<long>());
    std::string text = elements > 0 ? fmt::format("{} elements", elements) : "elements as the accuracy asks";
    if (record.at("engine") == "statics") return text;
    const RunRecord counts = notes.value("elements_from", RunRecord::array()), &accuracy = record.at("accuracy");
    if (counts.size() > 1) text += fmt::format(" at the end, {} at the start", counts.at(0).at("elements").get<long>());
    const double tolerance = notes.value("time_tolerance", parameters.at("time").at("tolerance").get<double>());
    if (tolerance > 0) text += fmt::format(", time tolerance {:g}", tolerance);
    if (accuracy.contains("resolution"))
        text += fmt::format("; relative accuracy {:g} asked for, {:.1e} reached", own.at("accuracy").get<double>(),
                            accuracy.at("resolution").at("largest").get<double>());
    return text;
}

std::string state_after(ExitReason reason) {
    return reason == ExitReason::interrupted ? "interrupted" : "finished";
}

void forget_events_after(RunRecord& record, double time_us) {
    RunRecord kept = RunRecord::object();
    for (const auto& [name, event] : record.at("events").items())
        if (event.at("time_us").get<double>() <= time_us) kept[name] = event;
    record["events"] = kept;
}

bool ended_in_order(const RunRecord& record) {
    return record.at("state") != "running";
}

}  // namespace endoflow
