#include "boundary_integral/driver/neck_events.h"

#include <limits>

namespace endoflow::boundary_integral {

NeckEvents::NeckEvents(const Parameters& parameters, const MembraneDynamics& dynamics, RunOutput& output)
    : parameters_(parameters), dynamics_(dynamics), output_(output) {}

std::optional<ExitReason> NeckEvents::look(const StiffIntegrator& integrator, HistoryRecorder& history,
                                           OutputSeries& series) {
    const auto neck_radius = [this](const Eigen::VectorXd& y) {
        const auto neck = find_neck(dynamics_.space(), dynamics_.unpack(y));
        return neck ? neck->radius : std::numeric_limits<double>::infinity();
    };
    if (!budded_) {
        if (const auto time = falls_below(integrator, neck_radius, budding_neck_radius)) {
            budded_ = true;
            record("budding", *time, integrator, history, series);
            if (parameters_.output.stop_at_budding) return ExitReason::budded;
        }
    }
    if (const auto time = falls_below(integrator, neck_radius, parameters_.boundary_integral.neck_closed_radius)) {
        record("neck_closed", *time, integrator, history, series);
        return ExitReason::neck_closed;
    }
    return std::nullopt;
}

void NeckEvents::record(const char* name, double time, const StiffIntegrator& integrator, HistoryRecorder& history,
                        OutputSeries& series) {
    series.write_shape_at(time, integrator);
    const Eigen::VectorXd y = integrator.state_at(time);
    if (time > history.last_row()) history.record(time, dynamics_.evaluate(y), integrator);
    const MembraneState state = dynamics_.unpack(y);
    const ShapeIntegrals shape = shape_integrals(dynamics_.space(), state, parameters_.domain);
    const auto neck = find_neck(dynamics_.space(), state);
    output_.record_event(name, time,
                         {{"neck_radius_nm", neck ? neck->radius : 0.0},
                          {"bud_diameter_nm", neck ? neck->lateral_diameter : 0.0},
                          {"bud_height_nm", shape.height},
                          {"membrane_area_nm2", shape.area}});
}

}  // namespace endoflow::boundary_integral
