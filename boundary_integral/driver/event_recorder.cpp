#include "boundary_integral/driver/event_recorder.h"

#include "shared/numerics/level_crossing.h"

namespace endoflow::boundary_integral {

EventRecorder::EventRecorder(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output)
    : dynamics_(dynamics),
      output_(output),
      domain_(parameters.domain),
      events_(parameters.output, parameters.boundary_integral.neck_closed_radius) {}

std::function<double(double time)> EventRecorder::neck_in(const StiffIntegrator& integrator) const {
    return [&](double time) {
        return neck_radius(find_neck(dynamics_.space(), dynamics_.unpack(integrator.state_at(time))));
    };
}

std::optional<double> EventRecorder::collar_due(const StiffIntegrator& integrator) const {
    if (!dynamics_.loads().collar_waits()) return std::nullopt;
    const double end = integrator.time();
    return falls_below(neck_in(integrator), end - integrator.last_step(), end, Loads::collar_radius);
}

std::optional<ExitReason> EventRecorder::look(double end, const StiffIntegrator& integrator, HistoryRecorder& history,
                                              OutputSeries& series) {
    for (const NeckEvent& event :
         events_.within(integrator.time() - integrator.last_step(), end, neck_in(integrator))) {
        record(event, integrator, history, series);
        if (event.ends_run) return event.ends_run;
    }
    return std::nullopt;
}

void EventRecorder::record(const NeckEvent& event, const StiffIntegrator& integrator, HistoryRecorder& history,
                           OutputSeries& series) {
    series.write_shape_at(event.time, integrator);
    const Eigen::VectorXd y = integrator.state_at(event.time);
    if (event.time > history.last_row()) history.record(event.time, dynamics_.evaluate(event.time, y), integrator);
    output_.record_event(event.name, event.time, measure_shape(dynamics_.space(), dynamics_.unpack(y), domain_));
}

}  // namespace endoflow::boundary_integral
