#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "shared/geometry/membrane_curve.h"
#include "shared/output/accuracy.h"
#include "shared/output/checkpoint.h"
#include "shared/output/history_columns.h"
#include "shared/output/run_record.h"

namespace endoflow {

/// What an engine may say of a run, and ask. RunFiles writes it into the run's directory, RunObserver is what the other
/// processes of a parallel run hold, RunMemory keeps it.
class RunOutput {
  public:
    RunOutput() = default;
    virtual ~RunOutput() = default;
    RunOutput(const RunOutput&) = delete;
    RunOutput& operator=(const RunOutput&) = delete;

    /// Where an engine puts what its processes write together: meshes, fields. Empty where a run has no directory.
    [[nodiscard]] virtual const std::filesystem::path& directory() const = 0;

    /// The checkpoint to continue from: set in a restart, empty in a fresh run.
    [[nodiscard]] virtual const std::optional<Checkpoint>& restart_point() const = 0;

    /// Whether the run is asked to stop, from its next step on.
    [[nodiscard]] virtual bool stop_requested() const = 0;

    /// A row of the history; wall_s is filled in. What leaves its bound of accuracy_bounds() becomes an alarm; beyond
    /// its limit, SolverError is thrown, by all processes alike.
    virtual void record_step(HistoryRow row) = 0;
    /// The same bounds for a quantity that is in no column of the history.
    virtual void watch(const AccuracyBound& bound, double time_us, double value) = 0;
    virtual void count_rejected_step() = 0;

    virtual void write_shape(double time_us, const MembraneCurve& curve) = 0;
    /// Fields that one process computed, as a file for ParaView.
    virtual void write_fields(double time_us, const std::string& vtu) = 0;

    /// run.json events: {"budding": {"time_us": …, what is measured on the shape then, null without a neck…}}. A name
    /// recorded before is not replaced.
    virtual void record_event(const std::string& name, double time_us, const ShapeMeasures& shape) = 0;

    /// run.json notes: anything an engine wants to say about the run as a whole.
    virtual void note(const std::string& key, const nlohmann::ordered_json& value) = 0;

    /// Adds to the phase's totals in run.json, s.
    virtual void add_phase_time(const std::string& phase, double wall_s, double cpu_s) = 0;

    /// One line of the log; warnings are also shown.
    virtual void log_info(const std::string& message) = 0;
    virtual void log_warning(const std::string& message) = 0;

    /// Whether it is time for a checkpoint.
    [[nodiscard]] virtual bool checkpoint_due() const = 0;
    virtual void write_checkpoint(const Checkpoint& checkpoint) = 0;

    /// The last word of a run that ended well or was interrupted.
    virtual void finish(ExitReason reason) = 0;
    /// The last word of a run that a failure ended.
    virtual void finish_with_error(const std::string& message) = 0;
};

}  // namespace endoflow
