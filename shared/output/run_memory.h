#pragma once

#include <vector>

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// A run that is on no disk: what the engine said is kept here, as the files of a run's directory would hold it. Fields
/// are not kept.
class RunMemory final : public RunOutput {
  public:
    struct Shape {
        double time_us;
        MembraneCurve curve;
    };

    /// Goes on from a checkpoint of the same problem where there is one.
    RunMemory(const Parameters& parameters, EngineIdentity engine, std::optional<Checkpoint> from = {});

    [[nodiscard]] const RunRecord& record() const { return record_; }            ///< run.json
    [[nodiscard]] const std::string& history() const { return history_; }        ///< history.csv
    [[nodiscard]] const std::vector<HistoryRow>& rows() const { return rows_; }  ///< of it
    [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }   ///< shapes.h5
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    [[nodiscard]] const std::optional<Checkpoint>& checkpoint() const { return checkpoint_; }  ///< the latest one

    /// Asks the engine to stop before its next step.
    void request_stop() { stop_requested_ = true; }

    [[nodiscard]] const std::filesystem::path& directory() const override { return nowhere_; }
    [[nodiscard]] const std::optional<Checkpoint>& restart_point() const override { return restart_point_; }
    [[nodiscard]] bool stop_requested() const override { return stop_requested_; }
    void record_step(HistoryRow row) override;
    void watch(const AccuracyBound& bound, double time_us, double value) override;
    void count_rejected_step() override;
    /// Throws SolverError when a value is not finite.
    void write_shape(double time_us, const MembraneCurve& curve) override;
    void write_fields(double, const std::string&) override {}
    void record_event(const std::string& name, double time_us, const ShapeMeasures& shape) override;
    void note(const std::string& key, const nlohmann::ordered_json& value) override;
    void add_phase_time(const std::string& phase, double wall_s, double cpu_s) override;
    void log_info(const std::string&) override {}
    void log_warning(const std::string& message) override { warnings_.push_back(message); }
    /// An engine writes one at its end.
    [[nodiscard]] bool checkpoint_due() const override { return false; }
    void write_checkpoint(const Checkpoint& checkpoint) override { checkpoint_ = checkpoint; }
    void finish(ExitReason reason) override;
    void finish_with_error(const std::string& message) override;

  private:
    EngineIdentity engine_;
    std::filesystem::path nowhere_;
    std::optional<Checkpoint> restart_point_, checkpoint_;
    RunRecord record_;
    AccuracyWatch accuracy_;
    double wall_start_;
    std::string history_;
    std::vector<HistoryRow> rows_;
    std::vector<Shape> shapes_;
    std::vector<std::string> warnings_;
    bool stop_requested_ = false;

    void end(const std::string& state, const std::string& reason);
};

}  // namespace endoflow
