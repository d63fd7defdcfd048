#pragma once

#include <memory>
#include <optional>

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

/// A run from t = 0 or from the output's restart point, step by step; the driver's other parts look at each of them:
/// rows of the history, events, shapes, fields, checkpoints.
class Run {
  public:
    /// Up to the first step. Throws IoError when the restart point does not fit the parameters. `output` must outlive
    /// the run.
    Run(const Parameters& parameters, RunOutput& output);
    ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Makes a step. Says why the run ended, when it did. Throws SolverError when it cannot go on.
    [[nodiscard]] std::optional<ExitReason> step();

    /// The membrane after the last step.
    [[nodiscard]] MembraneCurve shape() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace endoflow::boundary_integral
