#pragma once

#include "shared/output/run_output.h"
#include "shared/output/sudden_end.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// What every process of a parallel run holds but the one that owns the run's directory: it hands out the checkpoint,
/// stops where the owner does, and says nothing.
class RunObserver final : public RunOutput {
  public:
    /// `continues`: the run goes on from the directory's checkpoint. Throws IoError.
    RunObserver(const Parameters& parameters, const EngineIdentity& engine, std::filesystem::path directory,
                bool continues);

    [[nodiscard]] const std::filesystem::path& directory() const override { return directory_; }
    [[nodiscard]] const std::optional<Checkpoint>& restart_point() const override { return restart_point_; }
    [[nodiscard]] bool stop_requested() const override;
    /// Throws SolverError where the owner does.
    void record_step(HistoryRow row) override;
    void watch(const AccuracyBound& bound, double time_us, double value) override;
    void count_rejected_step() override {}
    void write_shape(double, const MembraneCurve&) override {}
    void write_fields(double, const std::string&) override {}
    void record_event(const std::string&, double, const ShapeMeasures&) override {}
    void note(const std::string&, const nlohmann::ordered_json&) override {}
    void add_phase_time(const std::string&, double, double) override {}
    void log_info(const std::string&) override {}
    void log_warning(const std::string&) override {}
    [[nodiscard]] bool checkpoint_due() const override { return false; }
    void write_checkpoint(const Checkpoint&) override {}
    void finish(ExitReason) override {}
    /// To the owner, which may not know of the failure.
    void finish_with_error(const std::string& message) override;

  private:
    std::filesystem::path directory_;
    std::optional<Checkpoint> restart_point_;
    RunRecord record_;  // what the watch must remember
    AccuracyWatch accuracy_;
    SuddenEnd sudden_end_;
};

}  // namespace endoflow
