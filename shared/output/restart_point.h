#pragma once

#include <filesystem>

#include "shared/output/checkpoint.h"
#include "shared/output/history_file.h"
#include "shared/output/run_directory.h"
#include "shared/output/run_record.h"
#include "shared/parameters/parameters.h"
#include "shared/support/error.h"

namespace endoflow {

/// What RunFiles adds to an engine's checkpoint.
namespace checkpoint_entry {
inline constexpr const char* record = "run_record";  // run.json as of then
inline constexpr const char* rows = "history_rows";  // rows of history.csv up to its time
inline constexpr const char* shapes = "shapes";      // shapes up to its time
}  // namespace checkpoint_entry

/// What a restart goes on from.
// NOLINTNEXTLINE(bugprone-exception-escape): what the analysis sees thrown in JSON's move is its own assertion.
struct RestartPoint {
    Checkpoint checkpoint;
    RunRecord record;              // as of the checkpoint
    KeptHistory history;           // what stays of history.csv
    std::filesystem::path shapes;  // the file with all shapes up to the checkpoint
    double reached_us = 0;         // the time up to which the run had got
    bool nothing_to_do = false;    // it had got as far as time.end
};

/// Reads the checkpoint and the record in it. Throws IoError.
[[nodiscard]] RestartPoint read_checkpoint(const RunDirectory& directory);

/// The same and all else that a restart needs. Everything that can be wrong with it is found here, and nothing is
/// changed. Throws IoError, and InputError when the parameters state another problem than the run's.
[[nodiscard]] RestartPoint read_restart_point(const RunDirectory& directory, const Parameters& parameters,
                                              const EngineIdentity& engine);

/// "not a complete run record" of the checkpoint.
[[nodiscard]] IoError incomplete_record(const RunDirectory& directory, const RunRecord::exception& failure);

}  // namespace endoflow
