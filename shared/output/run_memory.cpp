#include "shared/output/run_memory.h"

#include <utility>

#include "shared/output/history_file.h"
#include "shared/output/provenance.h"
#include "shared/output/shape_columns.h"

namespace endoflow {

RunMemory::RunMemory(const Parameters& parameters, EngineIdentity engine, std::optional<Checkpoint> from)
    : engine_(std::move(engine)),
      restart_point_(std::move(from)),
      record_(new_record(parameters, engine_)),
      accuracy_(parameters, engine_),
      wall_start_(wall_seconds()),
      history_(history_header(engine_.history_columns) + "\n") {}

void RunMemory::record_step(HistoryRow row) {
    row.wall_s = wall_seconds() - wall_start_;
    history_ += history_line(row, engine_.history_columns.size()) + "\n";
    rows_.push_back(row);
    record_["time_us"] = row.time_us;
    record_["steps"]["accepted"] = rows_.size();
    for (const Alarm& alarm : accuracy_.look_at(row, record_)) log_warning(alarm.describe());
}

void RunMemory::watch(const AccuracyBound& bound, double time_us, double value) {
    if (const auto alarm = AccuracyWatch::look_at(bound, time_us, value, record_)) log_warning(alarm->describe());
}

void RunMemory::count_rejected_step() {
    add_rejected_step(record_);
}

void RunMemory::write_shape(double time_us, const MembraneCurve& curve) {
    require_finite(curve);
    shapes_.push_back({time_us, curve});
}

void RunMemory::record_event(const std::string& name, double time_us, const ShapeMeasures& shape) {
    add_event(record_, name, time_us, shape);
}

void RunMemory::note(const std::string& key, const nlohmann::ordered_json& value) {
    record_["notes"][key] = value;
}

void RunMemory::add_phase_time(const std::string& phase, double wall_s, double cpu_s) {
    endoflow::add_phase_time(record_, phase, wall_s, cpu_s);
}

void RunMemory::finish(ExitReason reason) {
    end(state_after(reason), to_string(reason));
}

void RunMemory::finish_with_error(const std::string& message) {
    end("failed", message);
}

void RunMemory::end(const std::string& state, const std::string& reason) {
    record_["state"] = state;
    record_["exit_reason"] = reason;
    record_["ended"] = utc_now();
    record_["wall_s"] = wall_seconds() - wall_start_;
    record_["cpu_s"] = cpu_seconds();
    record_["resolution"] = resolution_in_words(record_);
}

}  // namespace endoflow
