#pragma once

#include <memory>

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

enum class StartMode { fresh, restart };

/// A run's directory: run.json, history.csv, shapes.h5, fields/, checkpoint/, log.txt and the live line.
///
/// It holds the directory's lock. A fresh start in a directory that already holds a run moves that run to earlier/N/
/// inside it: nothing is lost. A restart reads and checks all that it needs before it changes anything; then it drops
/// what was written after the checkpoint and goes on from there.
class RunFiles final : public RunOutput {
  public:
    /// Creates the directory and its files, run.json with state "running". Throws IoError, and InputError for a restart
    /// with another problem than the run's.
    RunFiles(const Parameters& parameters, EngineIdentity engine, std::filesystem::path directory, StartMode mode);
    ~RunFiles() override;

    /// True when a restart is asked for no more than what the run has reached: nothing was touched, and nothing may be
    /// called but directory() and reached_us().
    [[nodiscard]] bool nothing_to_do() const;
    /// The time up to which the run had got when this part of it began [µs].
    [[nodiscard]] double reached_us() const;

    /// For a run that may be killed before it reaches its next checkpoint: run.json as of the last one, with the state
    /// "interrupted"; false when there is none. Any thread may call it while another one computes.
    bool leave_interrupted();
    /// What an observer that ended left; empty when none did.
    [[nodiscard]] std::string word_of_another_process() const;
    /// For a run that cannot go on because another process has ended: run.json, log.txt and stderr say so, at once. Any
    /// thread of the owner may call it while another one computes; the process must end then.
    void leave_failed(const std::string& what_happened);

    [[nodiscard]] const std::filesystem::path& directory() const override;
    [[nodiscard]] const std::optional<Checkpoint>& restart_point() const override;
    /// SIGINT, SIGTERM or SIGHUP came.
    [[nodiscard]] bool stop_requested() const override;
    /// Appends to history.csv and moves the live line.
    void record_step(HistoryRow row) override;
    void watch(const AccuracyBound& bound, double time_us, double value) override;
    void count_rejected_step() override;
    /// Appends to shapes.h5.
    void write_shape(double time_us, const MembraneCurve& curve) override;
    void write_fields(double time_us, const std::string& vtu) override;
    void record_event(const std::string& name, double time_us, const ShapeMeasures& shape) override;
    void note(const std::string& key, const nlohmann::ordered_json& value) override;
    void add_phase_time(const std::string& phase, double wall_s, double cpu_s) override;
    /// Into log.txt; warnings also to stderr.
    void log_info(const std::string& message) override;
    void log_warning(const std::string& message) override;
    /// True when checkpoint_pause() of wall time has passed since the last checkpoint.
    [[nodiscard]] bool checkpoint_due() const override;
    void write_checkpoint(const Checkpoint& checkpoint) override;
    /// Prints how far the run got and where its results are.
    void finish(ExitReason reason) override;
    /// The message goes to log.txt and run.json.
    void finish_with_error(const std::string& message) override;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace endoflow
