#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shared/output/history_columns.h"
#include "shared/output/provenance.h"
#include "shared/output/run_directory.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// Whether the rows of history.csv follow each other in time, so that the live line can tell how far a run is.
enum class RowOrder { in_time, along_a_branch };

/// What an engine says of itself once.
struct EngineIdentity {
    std::string name;                         // "boundary-integral" or "phase-field"
    LibraryVersions libraries;                // what it is linked to
    std::vector<ColumnText> history_columns;  // its own columns of history.csv
    int processes = 1;
    int threads = 1;
    RowOrder row_order = RowOrder::in_time;
};

/// Why a run ended without an error.
enum class ExitReason { done, budded, neck_closed, interrupted };

[[nodiscard]] std::string to_string(ExitReason reason);

/// How a run that ended so goes on, to end a line with: "; continue with --restart" and what to change, for the same
/// case would end the same way again. Empty where nothing can be changed. `checkpoint_us`: time of the last checkpoint.
[[nodiscard]] std::string way_on(ExitReason reason, const EngineIdentity& engine, const Parameters& parameters,
                                 double checkpoint_us);

/// The content of run.json.
using RunRecord = nlohmann::ordered_json;

/// The largest run.json that is read, bytes.
inline constexpr std::uintmax_t largest_record = std::uintmax_t{1} << 26;

/// The record of a run that begins.
[[nodiscard]] RunRecord new_record(const Parameters& parameters, const EngineIdentity& engine);

/// Throws IoError that begins with `source` when the text is no run record.
[[nodiscard]] RunRecord parse_record(const std::string& text, const std::string& source);

/// run.json of a run. Throws IoError.
[[nodiscard]] RunRecord read_record(const RunDirectory& directory);

/// For a disk that takes no new file: the state in a run.json that says "running" is replaced in its place.
void overwrite_state(const RunDirectory& directory, const std::string& state);

/// Throws IoError when another engine wrote the record, InputError when the parameters state another problem than
/// the record's: only those that the parameter table marks as free may differ.
void require_continuable(const RunRecord& record, const Parameters& parameters, const EngineIdentity& engine,
                         const std::string& source);

/// Takes over the parameters and adds to `segments` when, where and with which version of the program this part of the
/// run begins, and with which values of the parameters that a restart may change.
void begin_segment(RunRecord& record, const Parameters& parameters, const EngineIdentity& engine, double begin_us);

/// What an engine says in a run goes into its record. An event recorded before is not replaced: false.
bool add_event(RunRecord& record, const std::string& name, double time_us, const ShapeMeasures& shape);
void add_rejected_step(RunRecord& record);
/// Adds to the phase's totals, s.
void add_phase_time(RunRecord& record, const std::string& phase, double wall_s, double cpu_s);

/// What was resolved, in words, from parameters, notes and accuracy: elements or layer, tolerance, accuracy reached.
/// run.json has it as `resolution`, which pages repeat.
[[nodiscard]] std::string resolution_in_words(const RunRecord& record);

/// The state of a run that ended without an error.
[[nodiscard]] std::string state_after(ExitReason reason);

/// A run that goes on from `time_us` meets them again, or does not: with another boundary_integral.neck_closed_radius
/// the neck closes later.
void forget_events_after(RunRecord& record, double time_us);

/// Whether the run that the record tells of had its last word: it is neither running nor was it killed.
[[nodiscard]] bool ended_in_order(const RunRecord& record);

}  // namespace endoflow
