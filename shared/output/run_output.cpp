#include "shared/output/run_output.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "shared/output/atomic_file.h"
#include "shared/output/live_line.h"
#include "shared/output/output_times.h"
#include "shared/output/run_directory.h"
#include "shared/output/run_lock.h"
#include "shared/output/shapes_file.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

constexpr const char* record_in_checkpoint = "run_record";
constexpr const char* rows_in_checkpoint = "history_rows";
constexpr const char* shapes_in_checkpoint = "shapes";
constexpr std::uintmax_t largest_record = std::uintmax_t{1} << 26;

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
    std::unique_ptr<RunLock> lock;
    RunRecord record;
    KeptHistory kept_history;
    std::filesystem::path kept_shapes;
    double reached = 0;  // µs
    bool nothing_to_do = false;
    std::optional<AccuracyWatch> accuracy;
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
        directory.make_root();
        lock = std::make_unique<RunLock>(directory);
        directory.prepare_fresh();
        record = new_record(parameters, engine);
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns);
        shapes = std::make_unique<ShapesFile>(directory.shapes());
    }

    void read_restart_point() {
        restart_point = read_checkpoint_file(directory.checkpoint());
        if (!restart_point)
            throw IoError(directory.checkpoint().string() + ": holds no checkpoint; run without --restart");
        record = parse_record(restart_point->text(record_in_checkpoint), directory.checkpoint().string());
    }

    /// Everything that can be wrong with a restart is found here, and nothing is changed.
    void prepare_restart() {
        directory.require_run();
        lock = std::make_unique<RunLock>(directory);
        read_restart_point();
        require_same_problem();
        kept_history = read_kept_history(directory.history(), engine.history_columns, restart_point->time_us,
                                         expected(rows_in_checkpoint));
        kept_shapes = choose_shapes();
        reached = std::max(restart_point->time_us, kept_history.reached);
        nothing_to_do = has_reached(parameters.time.end);
    }

    void require_same_problem() const {
        try {
            require_continuable(record, parameters, engine, directory.root.string());
        } catch (const RunRecord::exception& failure) {
            throw incomplete(failure);
        }
    }

    [[nodiscard]] IoError incomplete(const RunRecord::exception& failure) const {
        return IoError(fmt::format("{}: not a complete run record: {}; run without --restart",
                                   directory.checkpoint().string(), failure.what()));
    }

    [[nodiscard]] std::optional<long> expected(const char* count) const {
        if (!restart_point->scalars.contains(count)) return std::nullopt;
        return std::lround(restart_point->scalar(count));
    }

    /// A run that was killed may have written the row of its end, but not yet its last shape.
    [[nodiscard]] bool has_reached(double end) const {
        if (end <= restart_point->time_us * (1 + same_time)) return true;
        const bool complete = ended_in_order(last_words());
        return complete ? end <= reached * (1 + same_time) : end < reached * (1 - same_time);
    }

    /// run.json is newer than the record in the checkpoint, but need not be whole.
    [[nodiscard]] RunRecord last_words() const {
        try {
            return parse_record(read_file(directory.record(), largest_record), directory.record().string());
        } catch (const IoError&) {
            return record;
        }
    }

    /// The file with all shapes up to the checkpoint. A run that was killed may leave a shapes.h5 that was being
    /// written; the copy beside the checkpoint is whole, unless the disk damaged it.
    [[nodiscard]] std::filesystem::path choose_shapes() const {
        std::optional<IoError> failure;
        for (const auto& file : {directory.shapes_at_checkpoint(), directory.shapes()}) {
            try {
                const int count = count_shapes(file, restart_point->time_us);
                if (const auto wanted = expected(shapes_in_checkpoint); !wanted || count == *wanted) return file;
                if (!failure)
                    failure.emplace(fmt::format("{}: holds {} shapes up to t = {} µs, not all of the run",
                                                file.string(), count, restart_point->time_us));
            } catch (const IoError& error) {
                if (!failure) failure = error;
            }
        }
        throw IoError(
            fmt::format("{}; {} does not have all shapes either; restore one of them or run without "
                        "--restart",
                        failure->what(), directory.shapes().string()));
    }

    void continue_run() {
        try {
            record["restarts"] = record.at("restarts").get<int>() + 1;
            wall_before = record.at("wall_s").get<double>();
            cpu_before = record.at("cpu_s").get<double>();
            begin_segment(record, parameters, engine, restart_point->time_us);
        } catch (const RunRecord::exception& failure) {
            throw incomplete(failure);
        }
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns, std::move(kept_history));
        record["steps"]["accepted"] = history->rows();
        if (kept_shapes != directory.shapes()) copy_file_atomically(kept_shapes, directory.shapes());
        shapes = std::make_unique<ShapesFile>(directory.shapes(), restart_point->time_us);
    }

    void observe(StartMode mode) {
        if (mode == StartMode::restart)
            read_restart_point();
        else
            record = new_record(parameters, engine);
    }

    void open() {
        const double start = restart_point ? restart_point->time_us : 0;
        live_line = std::make_unique<LiveLine>(stdout, start, parameters.time.end);
        log = open_log(directory.log());
        log->info("{} engine, case '{}', {} at t = {} µs", engine.name, parameters.case_.name,
                  restart_point ? "continued" : "started", start);
        if (restart_point && kept_shapes == directory.shapes())
            warn(fmt::format("{}: is damaged; the shapes come from {}", directory.shapes_at_checkpoint().string(),
                             directory.shapes().string()));
        if (!lock->doubt().empty()) warn(lock->doubt());
        save_record();
    }

    void warn(const std::string& message) {
        log->warn(message);
        live_line->finish();
        fmt::print(stderr, "warning: {}\n", message);
    }

    void raise(const Alarm& alarm) {
        if (role == OutputRole::observer) return;
        warn(alarm.describe());
        save_record();
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
    : implementation_(std::make_unique<Implementation>()) {
    auto& self = *implementation_;
    self.directory = {std::move(directory)};
    self.parameters = parameters;
    self.engine = std::move(engine);
    self.role = role;
    self.accuracy.emplace(parameters, self.engine);
    if (role == OutputRole::observer)
        self.observe(mode);
    else if (mode == StartMode::fresh)
        self.start_fresh();
    else
        self.prepare_restart();
    if (role == OutputRole::observer || self.nothing_to_do) return;
    if (mode == StartMode::restart) self.continue_run();
    self.open();
}

RunOutput::~RunOutput() = default;

const std::filesystem::path& RunOutput::directory() const {
    return implementation_->directory.root;
}

const std::optional<Checkpoint>& RunOutput::restart_point() const {
    return implementation_->restart_point;
}

bool RunOutput::nothing_to_do() const {
    return implementation_->nothing_to_do;
}

double RunOutput::reached_us() const {
    return implementation_->reached;
}

void RunOutput::record_step(HistoryRow row) {
    auto& self = *implementation_;
    if (self.role == OutputRole::owner) {
        row.wall_s = self.wall();
        self.history->append(row);
        self.record["time_us"] = row.time_us;
        self.record["steps"]["accepted"] = self.record["steps"]["accepted"].get<long>() + 1;
        if (self.engine.row_order == RowOrder::in_time) self.live_line->update(row);
    }
    for (const Alarm& alarm : self.accuracy->look_at(row, self.record)) self.raise(alarm);
}

void RunOutput::watch(const AccuracyBound& bound, double time_us, double value) {
    if (const auto alarm = AccuracyWatch::look_at(bound, time_us, value, implementation_->record))
        implementation_->raise(*alarm);
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
    RunRecord event = {{"time_us", time_us}};
    for (const auto& [key, value] : values) event[key] = value;
    self.record["events"][name] = event;
    self.live_line->finish();
    fmt::print("{} at t = {:.6g} µs\n", name, time_us);
    log_info(fmt::format("{} at t = {:.9g} µs", name, time_us));
    self.save_record();
}

void RunOutput::note(const std::string& key, const RunRecord& value) {
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
    implementation_->warn(message);
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
    complete.scalars[shapes_in_checkpoint] = self.shapes->count_until(checkpoint.time_us);
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
