#include "shared/output/run_output.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "shared/output/atomic_file.h"
#include "shared/output/live_line.h"
#include "shared/output/run_directory.h"
#include "shared/output/shapes_file.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* record_in_checkpoint = "run_record";
constexpr const char* rows_in_checkpoint = "history_rows";

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file) {
    try {
        auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
        auto log = std::make_shared<spdlog::logger>("run", sink);
        log->set_pattern("%Y-%m-%dT%H:%M:%S %l %v");
        log->flush_on(spdlog::level::info);
        return log;
    } catch (const spdlog::spdlog_ex& failure) {
        throw IoError(fmt::format("{}: cannot be written: {}", file.string(), failure.what()));
    }
}

Json initial_record(const Parameters& parameters, const EngineIdentity& engine) {
    Json record;
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
    record["time_us"] = 0.0;
    record["steps"] = {{"accepted", 0}, {"rejected", 0}};
    record["wall_s"] = 0.0;
    record["cpu_s"] = 0.0;
    record["phases"] = Json::object();
    record["events"] = Json::object();
    record["notes"] = Json::object();
    return record;
}

Json parse_record(const std::string& text, const std::string& source) {
    try {
        Json record = Json::parse(text);
        if (record.at("format") != "endoflow run") throw IoError(source + ": not a run record of endoflow");
        return record;
    } catch (const Json::exception& failure) {
        throw IoError(fmt::format("{}: damaged run record: {}", source, failure.what()));
    }
}

void require_same(const std::string& key, const Json& before, const Json& now) {
    const auto dot = key.find('.');
    const std::string section = key.substr(0, dot), name = key.substr(dot + 1);
    const Json &old_value = before.at(section).at(name), &new_value = now.at(section).at(name);
    if (old_value != new_value)
        throw InputError(fmt::format("{} = {}: the run to continue has {}, which a restart cannot change", key,
                                     new_value.dump(), old_value.dump()));
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

struct RunOutput::Implementation {
    RunDirectory directory;
    Parameters parameters;
    EngineIdentity engine;
    OutputRole role;
    std::optional<Checkpoint> restart_point;
    Json record;
    double wall_start = wall_seconds();
    double wall_before = 0;  // s, of the parts of this run before a restart
    double cpu_before = 0;
    double last_checkpoint = wall_seconds();
    int shapes_saved = 0;  // in the copy beside the checkpoint
    std::shared_ptr<spdlog::logger> log;
    std::unique_ptr<HistoryFile> history;
    std::unique_ptr<ShapesFile> shapes;
    std::unique_ptr<LiveLine> live_line;

    void start_fresh() {
        directory.prepare_fresh();
        record = initial_record(parameters, engine);
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns);
        shapes = std::make_unique<ShapesFile>(directory.shapes());
    }

    void read_restart_point() {
        directory.require_run();
        restart_point = read_checkpoint_file(directory.checkpoint());
        if (!restart_point)
            throw IoError(directory.checkpoint().string() + ": holds no checkpoint; run without --restart");
    }

    void continue_run() {
        record = parse_record(restart_point->text(record_in_checkpoint), directory.checkpoint().string());
        try {
            take_over_record();
        } catch (const Json::exception& failure) {
            throw IoError(fmt::format("{}: not a complete run record: {}; run without --restart",
                                      directory.checkpoint().string(), failure.what()));
        }
        continue_history();
        continue_shapes();
    }

    void take_over_record() {
        if (record.at("engine") != engine.name)
            throw IoError(fmt::format("{}: was written by the {} engine, not by {}; run without --restart",
                                      directory.root.string(), record["engine"].get<std::string>(), engine.name));
        const Json now = parameters_to_json(parameters);
        for (const auto& key : engine.kept_parameters) require_same(key, record.at("parameters"), now);
        record["parameters"] = now;
        record["restarts"] = record.at("restarts").get<int>() + 1;
        wall_before = record.at("wall_s").get<double>();
        cpu_before = record.at("cpu_s").get<double>();
    }

    void continue_history() {
        std::optional<long> expected_rows;
        if (restart_point->scalars.contains(rows_in_checkpoint))
            expected_rows = std::lround(restart_point->scalar(rows_in_checkpoint));
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns, restart_point->time_us,
                                                expected_rows);
        record["steps"]["accepted"] = history->rows();
    }

    /// A run that was killed may leave a shapes.h5 that was being written; the copy beside the checkpoint is whole.
    void continue_shapes() {
        if (std::filesystem::exists(directory.shapes_at_checkpoint()))
            copy_file_atomically(directory.shapes_at_checkpoint(), directory.shapes());
        shapes = std::make_unique<ShapesFile>(directory.shapes(), restart_point->time_us);
    }

    /// Before the checkpoint itself, so that history and shapes always reach as far as it does.
    void save_series() {
        flush_to_disk(directory.history());
        if (shapes->count() == shapes_saved) return;
        copy_file_atomically(directory.shapes(), directory.shapes_at_checkpoint());
        shapes_saved = shapes->count();
    }

    [[nodiscard]] double wall() const { return wall_before + wall_seconds() - wall_start; }

    void save_record() {
        record["wall_s"] = wall();
        record["cpu_s"] = cpu_before + cpu_seconds();
        write_file_atomically(directory.record(), record.dump(2) + "\n");
    }

    void end(const std::string& state, const std::string& reason) {
        live_line->finish();
        record["state"] = state;
        record["exit_reason"] = reason;
        record["ended"] = utc_now();
        log->info("{}: {}", state, reason);
        save_record();
    }
};

RunOutput::RunOutput(const Parameters& parameters, EngineIdentity engine, std::filesystem::path directory,
                     StartMode mode, OutputRole role)
    : implementation_(new Implementation{.directory = {std::move(directory)},
                                         .parameters = parameters,
                                         .engine = std::move(engine),
                                         .role = role,
                                         .restart_point = {},
                                         .record = {},
                                         .log = {},
                                         .history = {},
                                         .shapes = {},
                                         .live_line = {}}) {
    auto& self = *implementation_;
    if (mode == StartMode::restart) self.read_restart_point();
    if (role == OutputRole::observer) return;
    if (mode == StartMode::restart)
        self.continue_run();
    else
        self.start_fresh();
    const double start = self.restart_point ? self.restart_point->time_us : 0;
    self.live_line = std::make_unique<LiveLine>(stdout, start, parameters.time.end);
    self.log = open_log(self.directory.log());
    self.log->info("{} engine, case '{}', {} at t = {} µs", self.engine.name, parameters.case_.name,
                   mode == StartMode::fresh ? "started" : "continued", start);
    self.save_record();
}

RunOutput::~RunOutput() = default;

const std::filesystem::path& RunOutput::directory() const {
    return implementation_->directory.root;
}

const std::optional<Checkpoint>& RunOutput::restart_point() const {
    return implementation_->restart_point;
}

void RunOutput::record_step(HistoryRow row) {
    if (implementation_->role == OutputRole::observer) return;
    auto& self = *implementation_;
    row.wall_s = self.wall();
    self.history->append(row);
    self.record["time_us"] = row.time_us;
    self.record["steps"]["accepted"] = self.record["steps"]["accepted"].get<long>() + 1;
    if (self.engine.row_order == RowOrder::in_time) self.live_line->update(row);
}

void RunOutput::count_rejected_step() {
    if (implementation_->role == OutputRole::observer) return;
    auto& rejected = implementation_->record["steps"]["rejected"];
    rejected = rejected.get<long>() + 1;
}

void RunOutput::write_shape(double time_us, const MembraneCurve& curve) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->shapes->append(time_us, curve);
}

void RunOutput::record_event(const std::string& name, double time_us, const std::map<std::string, double>& values) {
    if (implementation_->role == OutputRole::observer) return;
    auto& self = *implementation_;
    if (self.record["events"].contains(name)) return;
    Json event = {{"time_us", time_us}};
    for (const auto& [key, value] : values) event[key] = value;
    self.record["events"][name] = event;
    self.live_line->finish();
    fmt::print("{} at t = {:.6g} µs\n", name, time_us);
    log_info(fmt::format("{} at t = {:.9g} µs", name, time_us));
    self.save_record();
}

void RunOutput::note(const std::string& key, const Json& value) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->record["notes"][key] = value;
}

void RunOutput::add_phase_time(const std::string& phase, double wall_s, double cpu_s) {
    if (implementation_->role == OutputRole::observer) return;
    auto& totals = implementation_->record["phases"][phase];
    if (totals.is_null()) totals = {{"wall_s", 0.0}, {"cpu_s", 0.0}};
    totals["wall_s"] = totals["wall_s"].get<double>() + wall_s;
    totals["cpu_s"] = totals["cpu_s"].get<double>() + cpu_s;
}

void RunOutput::log_info(const std::string& message) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->log->info(message);
}

void RunOutput::log_warning(const std::string& message) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->log->warn(message);
    implementation_->live_line->finish();
    fmt::print(stderr, "warning: {}\n", message);
}

bool RunOutput::checkpoint_due() const {
    return wall_seconds() - implementation_->last_checkpoint > implementation_->parameters.output.checkpoint_interval;
}

void RunOutput::write_checkpoint(const Checkpoint& checkpoint) {
    if (implementation_->role == OutputRole::observer) return;
    auto& self = *implementation_;
    self.save_record();
    self.save_series();
    Checkpoint complete = checkpoint;
    complete.scalars[rows_in_checkpoint] = static_cast<double>(self.history->rows_until(checkpoint.time_us));
    complete.texts[record_in_checkpoint] = self.record.dump();
    write_checkpoint_file(self.directory.checkpoint(), complete);
    self.last_checkpoint = wall_seconds();
}

void RunOutput::finish(ExitReason reason) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->end(reason == ExitReason::interrupted ? "interrupted" : "finished", to_string(reason));
}

void RunOutput::finish_with_error(const std::string& message) {
    if (implementation_->role == OutputRole::observer) return;
    implementation_->end("failed", message);
}

PhaseTimer::PhaseTimer(RunOutput& output, std::string phase)
    : output_(output), phase_(std::move(phase)), wall_start_(wall_seconds()), cpu_start_(cpu_seconds()) {}

// Nothing but a lack of memory can throw here, and that may end the program.
PhaseTimer::~PhaseTimer() {  // NOLINT(bugprone-exception-escape)
    output_.add_phase_time(phase_, wall_seconds() - wall_start_, cpu_seconds() - cpu_start_);
}

}  // namespace endoflow
