#include "boundary_integral/driver/output_series.h"

#include "boundary_integral/fields/field_grid.h"
#include "shared/output/phase_timer.h"

namespace endoflow::boundary_integral {

OutputSeries::OutputSeries(const Parameters& parameters, const MembraneDynamics& dynamics, const FlowInterpolant& flow,
                           std::optional<double> goes_on_from, RunOutput& output)
    : parameters_(parameters),
      dynamics_(dynamics),
      flow_(flow),
      output_(output),
      plan_(parameters, goes_on_from.value_or(0.0)),
      sampler_(dynamics.space(), shape_points_per_element * dynamics.space().elements()) {}

MembraneCurve OutputSeries::curve_at(double time, const StiffIntegrator& integrator) const {
    return sampler_(dynamics_.unpack(integrator.state_at(time)), flow_.at(time));
}

bool OutputSeries::writes_fields() const {
    return parameters_.output.field_interval > 0.0 && dynamics_.box() != nullptr;
}

void OutputSeries::write_initial(const Evaluation& evaluation) {
    write_shape(0.0, evaluation.state, evaluation.flow);
    if (writes_fields()) {
        write_fields(0.0, evaluation.state, evaluation.flow,
                     dynamics_.box()->wall_unknowns(*evaluation.operators, evaluation.flow));
    }
}

void OutputSeries::write_until(double end, const StiffIntegrator& integrator) {
    plan_.shapes_until(end, [&](double time) { write_shape(time, integrator); });
    if (!writes_fields()) return;
    plan_.fields_until(end, [&](double time) {
        write_fields(time, dynamics_.unpack(integrator.state_at(time)), flow_.at(time),
                     flow_.wall_unknowns(time, *dynamics_.box()));
    });
}

void OutputSeries::write_shape_at(double time, const StiffIntegrator& integrator) {
    write_until(time, integrator);
    plan_.shape_at(time, [&](double at) { write_shape(at, integrator); });
}

void OutputSeries::write_shape(double time, const StiffIntegrator& integrator) {
    write_shape(time, dynamics_.unpack(integrator.state_at(time)), flow_.at(time));
}

void OutputSeries::write_shape(double time, const MembraneState& state, const FlowSolution& flow) {
    const PhaseTimer timer(output_, "shapes");
    output_.write_shape(time, sampler_(state, flow));
}

void OutputSeries::write_fields(double time, const MembraneState& state, const FlowSolution& flow,
                                const Eigen::VectorXd& wall_unknowns) {
    const PhaseTimer timer(output_, "fields");
    const QuadGrid grid =
        field_grid(parameters_, dynamics_, state, flow, wall_unknowns, parameters_.boundary_integral.field_spacing);
    output_.write_fields(time, vtu_text(grid));
}

}  // namespace endoflow::boundary_integral
