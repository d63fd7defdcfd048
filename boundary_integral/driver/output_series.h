#pragma once

#include <optional>

#include "boundary_integral/driver/flow_interpolant.h"
#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/output/output_plan.h"
#include "shared/output/run_output.h"

namespace endoflow::boundary_integral {

/// shapes.h5 and fields/ when OutputPlan says so.
class OutputSeries {
  public:
    /// `flow`: between the steps that are written; `goes_on_from`: the time [µs] up to which there are outputs already.
    OutputSeries(const Parameters& parameters, const MembraneDynamics& dynamics, const FlowInterpolant& flow,
                 std::optional<double> goes_on_from, RunOutput& output);

    /// Shape and fields of the initial state.
    void write_initial(const Evaluation& evaluation);

    /// Everything due up to a time inside the integrator's last step.
    void write_until(double time, const StiffIntegrator& integrator);

    /// The same, and the shape at this very time: of an event, of the end.
    void write_shape_at(double time, const StiffIntegrator& integrator);

    /// The membrane at a time inside the integrator's last step.
    [[nodiscard]] MembraneCurve curve_at(double time, const StiffIntegrator& integrator) const;

  private:
    const Parameters& parameters_;
    const MembraneDynamics& dynamics_;
    const FlowInterpolant& flow_;
    RunOutput& output_;
    OutputPlan plan_;
    CurveSampler sampler_;

    [[nodiscard]] bool writes_fields() const;
    void write_shape(double time, const StiffIntegrator& integrator);
    void write_shape(double time, const MembraneState& state, const FlowSolution& flow);
    void write_fields(double time, const MembraneState& state, const FlowSolution& flow,
                      const Eigen::VectorXd& wall_unknowns);
};

}  // namespace endoflow::boundary_integral
