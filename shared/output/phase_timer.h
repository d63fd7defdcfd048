#pragma once

#include <string>

#include "shared/output/run_output.h"

namespace endoflow {

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
