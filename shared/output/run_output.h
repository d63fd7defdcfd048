#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/geometry/membrane_curve.h"
#include "shared/output/accuracy.h"
#include "shared/output/checkpoint.h"
#include "shared/output/history_file.h"
#include "shared/output/run_record.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

enum class StartMode { fresh, restart };

/// With several processes one owns the directory; the observers read the checkpoint and write nothing.
enum class OutputRole { owner, observer };

/// The only door to a run's directory: run.json, history.csv, shapes.h5, checkpoint/, log.txt and the live line.
/// Every process of a parallel run holds one; those of observers do nothing but hand out the checkpoint.
///
/// The owner holds the directory's lock. A fresh start in a directory that already holds a run moves that run to
/// earlier/N/ inside it: nothing is lost. A restart reads and checks all that it needs before it changes anything; then
/// it drops what was written after the checkpoint and goes on from there.
class RunOutput {
  public:
    /// Creates the directory and its files, run.json with state "running". Throws IoError, and InputError for a restart
    /// with another problem than the run's.
    RunOutput(const Parameters& parameters, EngineIdentity engine, std::filesystem::path directory, StartMode mode,
              OutputRole role = OutputRole::owner);
    ~RunOutput();
    RunOutput(const RunOutput&) = delete;
    RunOutput& operator=(const RunOutput&) = delete;

    [[nodiscard]] const std::filesystem::path& directory() const;

    /// The checkpoint to continue from: set in a restart, empty in a fresh run.
    [[nodiscard]] const std::optional<Checkpoint>& restart_point() const;

    /// True when a restart is asked for no more than what the run has reached: nothing was touched, and nothing may be
    /// called but directory() and reached_us().
    [[nodiscard]] bool nothing_to_do() const;
    /// The time up to which the run had got when this part of it began [µs].
    [[nodiscard]] double reached_us() const;

    /// Appends to history.csv and moves the live line. wall_s is filled in here. What leaves its bound of
    /// accuracy_bounds() becomes an alarm; beyond its limit, SolverError is thrown, by all processes alike.
    void record_step(HistoryRow row);
    /// The same bounds for a quantity that is in no column of the history.
    void watch(const AccuracyBound& bound, double time_us, double value);
    void count_rejected_step();

    /// Appends to shapes.h5.
    void write_shape(double time_us, const MembraneCurve& curve);

    /// run.json events: {"budding": {"time_us": …, what is measured on the shape then, null without a neck…}}. A name
    /// recorded before is not replaced.
    void record_event(const std::string& name, double time_us, const ShapeMeasures& shape);

    /// run.json notes: anything an engine wants to say about the run as a whole.
    void note(const std::string& key, const nlohmann::ordered_json& value);

    /// Adds to the phase's totals in run.json, s.
    void add_phase_time(const std::string& phase, double wall_s, double cpu_s);

    /// One line into log.txt; warnings also to stderr.
    void log_info(const std::string& message);
    void log_warning(const std::string& message);

    /// True when checkpoint_pause() of wall time has passed since the last checkpoint.
    [[nodiscard]] bool checkpoint_due() const;
    void write_checkpoint(const Checkpoint& checkpoint);

    /// The last word of a run that ended well or was interrupted; prints how far it got and where its results are.
    void finish(ExitReason reason);
    /// For a run that may be killed before it reaches its next checkpoint: run.json as of the last one, with the state
    /// "interrupted"; false when there is none. Any thread may call it while another one computes.
    bool leave_interrupted();
    /// The last word of a run that a failure ended; the message goes to log.txt and run.json. That of an observer goes
    /// to the owner, which may not know of the failure.
    void finish_with_error(const std::string& message);
    /// What an observer that ended left; empty when none did.
    [[nodiscard]] std::string word_of_another_process() const;
    /// For a run that cannot go on because another process has ended: run.json, log.txt and stderr say so, at once. Any
    /// thread of the owner may call it while another one computes; the process must end then.
    void leave_failed(const std::string& what_happened);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Measures wall and CPU time of a phase from construction to destruction and adds it to run.json.
class PhaseTimer {
  public:
    PhaseTimer(RunOutput& output, std::string phase);
    ~PhaseTimer();  // NOLINT(bugprone-exception-escape)
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

  private:
    RunOutput& output_;
    std::string phase_;
    double wall_start_;
    double cpu_start_;
};

}  // namespace endoflow
