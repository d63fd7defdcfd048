#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shared/output/run_record.h"

namespace endoflow {

/// What happened to a neck inside a step.
struct NeckEvent {
    std::string name;
    double time;                         ///< µs
    std::optional<ExitReason> ends_run;  ///< why the run ends with it, when it does
};

/// The events of a run, in all engines alike: "budding" when the neck falls below budding_neck_radius for the first
/// time, "neck_closed" when it falls below the radius at which an engine does not follow it any more.
class NeckEvents {
  public:
    NeckEvents(const OutputParameters& output, double closed_radius)
        : stop_at_budding_(output.stop_at_budding), closed_radius_(closed_radius) {}

    /// Events between the begin and the end of a step [µs], in order. `radius`: the neck's at a time between them, nm,
    /// infinite where there is none.
    [[nodiscard]] std::vector<NeckEvent> within(double begin, double end,
                                                const std::function<double(double time)>& radius);

    [[nodiscard]] bool budded() const { return budded_; }
    void restore(bool budded) { budded_ = budded; }

  private:
    bool stop_at_budding_;
    double closed_radius_;
    bool budded_ = false;
};

}  // namespace endoflow
