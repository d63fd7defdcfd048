#include "shared/output/restart_point.h"
#include "shared/output/checkpoint_file.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "shared/output/output_plan.h"
#include "shared/output/shapes_file.h"

namespace endoflow {

namespace {

std::optional<long> expected(const Checkpoint& checkpoint, const char* count) {
    if (!checkpoint.scalars.contains(count)) return std::nullopt;
    return std::lround(checkpoint.scalar(count));
}

/// run.json is newer than the record in the checkpoint, but need not be whole.
RunRecord last_words(const RunDirectory& directory, const RunRecord& otherwise) {
    try {
        return read_record(directory);
    } catch (const IoError&) {
        return otherwise;
    }
}

/// A run that was killed may have written the row of its end, but not yet its last shape.
bool has_reached(double end, const RestartPoint& point, const RunDirectory& directory) {
    if (end <= point.checkpoint.time_us * (1 + same_time)) return true;
    const bool complete = ended_in_order(last_words(directory, point.record));
    return complete ? end <= point.reached_us * (1 + same_time) : end < point.reached_us * (1 - same_time);
}

/// A run that was killed may leave a shapes.h5 that was being written; the copy beside the checkpoint is whole, unless
/// the disk damaged it.
std::filesystem::path choose_shapes(const RunDirectory& directory, const Checkpoint& checkpoint) {
    std::optional<IoError> failure;
    for (const auto& file : {directory.shapes_at_checkpoint(), directory.shapes()}) {
        try {
            const int count = count_shapes(file, checkpoint.time_us);
            const auto wanted = expected(checkpoint, checkpoint_entry::shapes);
            if (!wanted || count == *wanted) return file;
            if (!failure)
                failure.emplace(fmt::format("{}: holds {} shapes up to t = {} µs, not all of the run", file.string(),
                                            count, checkpoint.time_us));
        } catch (const IoError& error) {
            if (!failure) failure = error;
        }
    }
    throw IoError(fmt::format("{}; {} does not have all shapes either; restore one of them or run without --restart",
                              failure->what(), directory.shapes().string()));
}

}  // namespace

IoError incomplete_record(const RunDirectory& directory, const RunRecord::exception& failure) {
    return IoError(fmt::format("{}: not a complete run record: {}; run without --restart",
                               directory.checkpoint().string(), failure.what()));
}

RestartPoint read_checkpoint(const RunDirectory& directory) {
    const std::string source = directory.checkpoint().string();
    auto checkpoint = read_checkpoint_file(directory.checkpoint());
    if (!checkpoint) throw IoError(source + ": holds no checkpoint; run without --restart");
    RestartPoint point;
    point.checkpoint = std::move(*checkpoint);
    point.record = parse_record(point.checkpoint.text(checkpoint_entry::record), source);
    return point;
}

RestartPoint read_restart_point(const RunDirectory& directory, const Parameters& parameters,
                                const EngineIdentity& engine) {
    RestartPoint point = read_checkpoint(directory);
    try {
        require_continuable(point.record, parameters, engine, directory.root.string());
    } catch (const RunRecord::exception& failure) {
        throw incomplete_record(directory, failure);
    }
    const double time = point.checkpoint.time_us;
    point.history = read_kept_history(directory.history(), engine.history_columns, time,
                                      expected(point.checkpoint, checkpoint_entry::rows));
    point.shapes = choose_shapes(directory, point.checkpoint);
    point.reached_us = std::max(time, point.history.reached);
    point.nothing_to_do = has_reached(parameters.time.end, point, directory);
    return point;
}

}  // namespace endoflow
