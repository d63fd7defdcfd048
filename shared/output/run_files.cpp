#include "shared/output/run_files.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <mutex>

#include "shared/output/atomic_file.h"
#include "shared/output/checkpoint_file.h"
#include "shared/output/field_index.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/history_file.h"
#include "shared/output/live_line.h"
#include "shared/output/output_plan.h"
#include "shared/output/output_size.h"
#include "shared/output/restart_point.h"
#include "shared/output/run_lock.h"
#include "shared/output/shapes_file.h"
#include "shared/output/sudden_end.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow {

namespace {

constexpr std::uintmax_t largest_word = 10000;  // of another process, bytes

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

struct RunFiles::Implementation {
    RunDirectory directory;
    Parameters parameters;
    EngineIdentity engine;
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
    double last_checkpoint_us = 0;
    int checkpoints = 0;
    std::mutex saving;                 // of run.json
    std::string words_if_interrupted;  // run.json as of the last checkpoint
    int shapes_saved = 0;              // in the copy beside the checkpoint
    std::shared_ptr<spdlog::logger> log;
    std::unique_ptr<HistoryFile> history;
    std::unique_ptr<ShapesFile> shapes;
    std::optional<FieldIndex> fields;
    std::unique_ptr<LiveLine> live_line;
    std::unique_ptr<SuddenEnd> sudden_end;  // while the run has had no last word

    void start_fresh() {
        directory.make_root();
        lock = std::make_unique<RunLock>(directory);
        directory.prepare_fresh();
        record = new_record(parameters, engine);
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns);
        shapes = std::make_unique<ShapesFile>(directory.shapes());
        fields.emplace(directory);
    }

    void prepare_restart() {
        require_run();
        lock = std::make_unique<RunLock>(directory);
        directory.require_run();  // what was seen before may have been moved since
        take(read_restart_point(directory, parameters, engine));
    }

    /// While another process starts a run, the one that was there is on its way to earlier/: throws who it is.
    void require_run() const {
        try {
            directory.require_run();
        } catch (const IoError&) {
            if (std::filesystem::exists(directory.lock())) {
                const RunLock nobody(directory);
            }
            throw;
        }
    }

    void take(RestartPoint point) {
        restart_point = std::move(point.checkpoint);
        record = std::move(point.record);
        kept_history = std::move(point.history);
        kept_shapes = std::move(point.shapes);
        reached = point.reached_us;
        nothing_to_do = point.nothing_to_do;
    }

    void continue_run() {
        try {
            record["restarts"] = record.at("restarts").get<int>() + 1;
            wall_before = record.at("wall_s").get<double>();
            cpu_before = record.at("cpu_s").get<double>();
            begin_segment(record, parameters, engine, restart_point->time_us);
        } catch (const RunRecord::exception& failure) {
            throw incomplete_record(directory, failure);
        }
        forget_events_after(record, restart_point->time_us);
        history = std::make_unique<HistoryFile>(directory.history(), engine.history_columns, std::move(kept_history));
        record["steps"]["accepted"] = history->rows();
        if (kept_shapes != directory.shapes()) copy_file_atomically(kept_shapes, directory.shapes());
        shapes = std::make_unique<ShapesFile>(directory.shapes(), restart_point->time_us);
        fields.emplace(directory, restart_point->time_us);
    }

    void open() {
        const double start = restart_point ? restart_point->time_us : 0;
        live_line = std::make_unique<LiveLine>(stdout, start, parameters.time.end);
        log = open_log(directory.log());
        log->info("{} engine, case '{}', {} at t = {} µs", engine.name, parameters.case_.name,
                  restart_point ? "continued" : "started", start);
        if (engine.row_order == RowOrder::in_time) tell_size(start);
        if (restart_point && kept_shapes == directory.shapes())
            warn(fmt::format("{}: is damaged; the shapes come from {}", directory.shapes_at_checkpoint().string(),
                             directory.shapes().string()));
        if (!lock->doubt().empty()) warn(lock->doubt());
        std::filesystem::remove(directory.word_of_a_process());
        sudden_end = std::make_unique<SuddenEnd>(directory, record);
        sudden_end->reached(start, record["steps"]["accepted"].get<long>());
        if (restart_point) sudden_end->checkpoint_written();
        save_record();
    }

    void tell_size(double start) {
        const std::string much = much_output(parameters, engine.name, start);
        if (much.empty()) return;
        log->info(much);
        say(stdout, fmt::format("{}; to write less, {}\n", much, less_output));
    }

    void warn(const std::string& message) {
        log->warn(message);
        live_line->finish();
        say(stderr, "warning: " + message + "\n");
    }

    void raise(const Alarm& alarm) {
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
        record["resolution"] = resolution_in_words(record);
        if (sudden_end) sudden_end->renew(record);
        const std::lock_guard<std::mutex> guard(saving);
        write_file_atomically(directory.record(), record.dump(2) + "\n");
    }

    /// Checkpoints cost the time that engines measure under this name.
    [[nodiscard]] double seconds_between_checkpoints() const {
        const auto phase = record["phases"].find("checkpoint");
        const double spent = phase == record["phases"].end() ? 0 : phase->at("wall_s").get<double>();
        return checkpoint_pause(parameters.output.checkpoint_interval, checkpoints == 0 ? 0 : spent / checkpoints);
    }

    /// How far the run got and where its results are; `how` begins the line.
    void tell(const std::string& how, ExitReason reason) const {
        const std::string when = engine.row_order == RowOrder::in_time
                                     ? fmt::format(" at t = {:.6g} µs", record["time_us"].get<double>())
                                     : "";
        say(stdout, fmt::format("{}{}; results in {}{}\n", how, when, one_line(directory.root.string()),
                                way_on(reason, engine, parameters, last_checkpoint_us)));
    }

    void end(const std::string& state, const std::string& reason) {
        sudden_end.reset();
        live_line->finish();
        record["state"] = state;
        record["exit_reason"] = reason;
        record["ended"] = utc_now();
        log->info("{}: {}", state, reason);
        try {
            save_record();
        } catch (const IoError&) {
            overwrite_state(directory, state);
            throw;
        }
    }
};

RunFiles::RunFiles(const Parameters& parameters, EngineIdentity engine, std::filesystem::path directory, StartMode mode)
    : implementation_(std::make_unique<Implementation>()) {
    auto& self = *implementation_;
    self.directory = {std::move(directory)};
    self.parameters = parameters;
    self.engine = std::move(engine);
    self.engine.libraries["hdf5"] = hdf5_version();
    self.accuracy.emplace(parameters, self.engine);
    if (mode == StartMode::fresh)
        self.start_fresh();
    else
        self.prepare_restart();
    if (self.nothing_to_do) return;
    if (mode == StartMode::restart) self.continue_run();
    self.open();
}

RunFiles::~RunFiles() = default;

const std::filesystem::path& RunFiles::directory() const {
    return implementation_->directory.root;
}

const std::optional<Checkpoint>& RunFiles::restart_point() const {
    return implementation_->restart_point;
}

bool RunFiles::stop_requested() const {
    return interruption_signal() != 0;
}

bool RunFiles::nothing_to_do() const {
    return implementation_->nothing_to_do;
}

double RunFiles::reached_us() const {
    return implementation_->reached;
}

void RunFiles::record_step(HistoryRow row) {
    auto& self = *implementation_;
    row.wall_s = self.wall();
    self.history->append(row);
    self.record["time_us"] = row.time_us;
    self.record["steps"]["accepted"] = self.record["steps"]["accepted"].get<long>() + 1;
    self.sudden_end->reached(row.time_us, self.record["steps"]["accepted"].get<long>());
    if (self.engine.row_order == RowOrder::in_time) self.live_line->update(row);
    for (const Alarm& alarm : self.accuracy->look_at(row, self.record)) self.raise(alarm);
}

void RunFiles::watch(const AccuracyBound& bound, double time_us, double value) {
    if (const auto alarm = AccuracyWatch::look_at(bound, time_us, value, implementation_->record))
        implementation_->raise(*alarm);
}

void RunFiles::count_rejected_step() {
    add_rejected_step(implementation_->record);
}

void RunFiles::write_shape(double time_us, const MembraneCurve& curve) {
    implementation_->shapes->append(time_us, curve);
}

void RunFiles::write_fields(double time_us, const std::string& vtu) {
    implementation_->fields->add(time_us, vtu);
}

void RunFiles::record_event(const std::string& name, double time_us, const ShapeMeasures& shape) {
    auto& self = *implementation_;
    if (!add_event(self.record, name, time_us, shape)) return;
    self.live_line->finish();
    say(stdout, fmt::format("{} at t = {:.6g} µs\n", name, time_us));
    log_info(fmt::format("{} at t = {:.9g} µs", name, time_us));
    self.save_record();
}

void RunFiles::note(const std::string& key, const RunRecord& value) {
    implementation_->record["notes"][key] = value;
}

void RunFiles::add_phase_time(const std::string& phase, double wall_s, double cpu_s) {
    endoflow::add_phase_time(implementation_->record, phase, wall_s, cpu_s);
}

void RunFiles::log_info(const std::string& message) {
    implementation_->log->info(message);
}

void RunFiles::log_warning(const std::string& message) {
    implementation_->warn(message);
}

bool RunFiles::checkpoint_due() const {
    const auto& self = *implementation_;
    return wall_seconds() - self.last_checkpoint > self.seconds_between_checkpoints();
}

void RunFiles::write_checkpoint(const Checkpoint& checkpoint) {
    auto& self = *implementation_;
    self.save_record();
    self.save_series();
    Checkpoint complete = checkpoint;
    complete.scalars[checkpoint_entry::rows] = static_cast<double>(self.history->rows_until(checkpoint.time_us));
    complete.scalars[checkpoint_entry::shapes] = self.shapes->count_until(checkpoint.time_us);
    complete.texts[checkpoint_entry::record] = self.record.dump();
    write_checkpoint_file(self.directory.checkpoint(), complete);
    self.last_checkpoint = wall_seconds();
    self.last_checkpoint_us = checkpoint.time_us;
    ++self.checkpoints;
    self.sudden_end->checkpoint_written();
    RunRecord interrupted = self.record;
    interrupted["state"] = "interrupted";
    interrupted["exit_reason"] = to_string(ExitReason::interrupted);
    const std::lock_guard<std::mutex> guard(self.saving);
    self.words_if_interrupted = interrupted.dump(2) + "\n";
}

void RunFiles::finish(ExitReason reason) {
    implementation_->end(state_after(reason), to_string(reason));
    implementation_->tell(reason == ExitReason::interrupted ? "interrupted, checkpoint written,"
                          : reason == ExitReason::done      ? "finished"
                                                            : "ended: " + to_string(reason) + ",",
                          reason);
}

bool RunFiles::leave_interrupted() {
    auto& self = *implementation_;
    const std::lock_guard<std::mutex> guard(self.saving);
    if (self.words_if_interrupted.empty()) return false;
    write_file_atomically(self.directory.record(), self.words_if_interrupted);
    return true;
}

std::string RunFiles::word_of_another_process() const {
    const auto file = implementation_->directory.word_of_a_process();
    return std::filesystem::exists(file) ? read_file(file, largest_word) : "";
}

void RunFiles::leave_failed(const std::string& what_happened) {
    const std::lock_guard<std::mutex> guard(implementation_->saving);
    leave_last_word(what_happened.c_str());
    std::error_code ignored;
    std::filesystem::remove(implementation_->directory.word_of_a_process(), ignored);
}

void RunFiles::finish_with_error(const std::string& message) {
    implementation_->end("failed", message);
}

}  // namespace endoflow
