#include "boundary_integral/simulation.h"

#include <cblas.h>
#include <sundials/sundials_version.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <utility>

#include "boundary_integral/evolution/material_strain.h"
#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/evolution/stiff_integrator.h"
#include "boundary_integral/fields/field_grid.h"
#include "shared/geometry/observables.h"
#include "shared/output/field_index.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::boundary_integral {

namespace {

constexpr Index shape_points_per_element = 8;
constexpr double smallest_step = 1e-14;  // us

// What the run remembers beside the state vector.
struct RunMemory {
    double next_step = 0.0;       // us
    double shapes_written = 0.0;  // number of output times done
    double budded = 0.0;          // 1 once the budding event is recorded
};

Checkpoint make_checkpoint(double time, const Eigen::VectorXd& y, const MaterialStrain& strain,
                           const RunMemory& memory) {
    Checkpoint checkpoint;
    checkpoint.time_us = time;
    checkpoint.scalars = {
        {"next_step", memory.next_step}, {"shapes_written", memory.shapes_written}, {"budded", memory.budded}};
    checkpoint.arrays = {{"state", std::vector<double>(y.begin(), y.end())},
                         {"marker_xi", strain.markers().xi},
                         {"marker_log_growth", strain.markers().log_growth}};
    return checkpoint;
}

class Run {
  public:
    Run(const Parameters& parameters, RunOutput& output)
        : parameters_(parameters),
          output_(output),
          dynamics_(parameters),
          strain_(dynamics_.space()),
          start_(restore()),
          fields_(field_index()) {}

    ExitReason execute() {
        StiffIntegrator integrator(problem(), start_.time, start_.y,
                                   {memory_.next_step, parameters_.time.max_step, smallest_step});
        strain_rates_ = strain_.rates(dynamics_.evaluate(start_.y));
        if (memory_.shapes_written == 0.0) write_first_shape();
        if (!output_.restart_point()) write_fields(integrator);
        while (integrator.time() < parameters_.time.end) {
            if (interruption_signal() != 0) return stop(integrator, ExitReason::interrupted);
            const double before = integrator.time();
            const auto outcome = advance(integrator);
            record(integrator, before);
            write_shapes(integrator);
            write_fields(integrator);
            if (outcome == StiffIntegrator::Outcome::event && memory_.budded == 0.0) {
                record_budding(integrator);
                if (parameters_.output.stop_at_budding) return stop(integrator, ExitReason::budded);
            }
            if (neck_closed_) return stop(integrator, ExitReason::neck_closed);
            if (output_.checkpoint_due())
                output_.write_checkpoint(make_checkpoint(integrator.time(), integrator.state(), strain_, memory_));
        }
        return stop(integrator, ExitReason::done);
    }

  private:
    struct Start {
        double time = 0.0;
        Eigen::VectorXd y;
    };

    const Parameters& parameters_;
    RunOutput& output_;
    MembraneDynamics dynamics_;
    RunMemory memory_;
    MaterialStrain strain_;
    MaterialRates strain_rates_;  // at the last accepted state
    Start start_;
    FieldIndex fields_;
    Evaluation latest_;  // of the last rate the integrator asked for
    Eigen::VectorXd latest_vector_;
    long rejected_ = 0;
    bool neck_closed_ = false;

    Start restore() {
        memory_.next_step = parameters_.time.initial_step;
        const auto& checkpoint = output_.restart_point();
        if (!checkpoint) return {0.0, dynamics_.initial_vector()};
        const std::vector<double>& state = checkpoint->array("state");
        if (static_cast<Index>(state.size()) != dynamics_.size()) {
            throw InputError(
                "the checkpoint in " + output_.directory().string() +
                " was made with another number of elements; restart with the same boundary_integral.elements");
        }
        memory_ = {checkpoint->scalar("next_step"), checkpoint->scalar("shapes_written"), checkpoint->scalar("budded")};
        strain_.restore({checkpoint->array("marker_xi"), checkpoint->array("marker_log_growth")});
        return {checkpoint->time_us, Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Index>(state.size()))};
    }

    StiffProblem problem() {
        StiffProblem problem;
        problem.rate = [this](double, const Eigen::VectorXd& y) {
            latest_ = dynamics_.evaluate(y);
            latest_vector_ = y;
            return latest_.rate;
        };
        problem.jacobian = [this](double, const Eigen::VectorXd& y) {
            if (latest_vector_.size() == y.size() && latest_vector_ == y) return dynamics_.jacobian(latest_);
            return dynamics_.jacobian(dynamics_.evaluate(y));
        };
        problem.event = [this](const Eigen::VectorXd& y) {
            const auto neck = find_neck(dynamics_.space(), dynamics_.unpack(y));
            return (neck ? neck->radius : 2.0 * budding_neck_radius) - budding_neck_radius;
        };
        // One unit of error: time.tolerance nm in the curve, time.tolerance in the concentration.
        problem.error_scales = dynamics_.error_scales(start_.y, parameters_.time.tolerance, parameters_.time.tolerance);
        return problem;
    }

    StiffIntegrator::Outcome advance(StiffIntegrator& integrator) {
        const PhaseTimer timer(output_, "time steps");
        const auto outcome = integrator.advance(parameters_.time.end);
        const auto statistics = integrator.statistics();
        const long rejected = statistics.error_test_failures + statistics.convergence_failures;
        for (; rejected_ < rejected; ++rejected_) output_.count_rejected_step();
        memory_.next_step = std::max(integrator.last_step(), smallest_step * 100.0);
        return outcome;
    }

    void record(const StiffIntegrator& integrator, double time_before) {
        const PhaseTimer timer(output_, "observables");
        const MembraneSpace& space = dynamics_.space();
        const Evaluation accepted = dynamics_.evaluate(integrator.state());
        const MembraneState& state = accepted.state;
        const ShapeIntegrals shape = shape_integrals(space, state, parameters_.domain);
        check_walls(shape, integrator.time());
        const auto neck = find_neck(space, state);
        HistoryRow row;
        row.time_us = integrator.time();
        row.step_us = integrator.last_step();
        if (neck) {
            row.neck_radius_nm = neck->radius;
            row.bud_diameter_nm = 2.0 * neck->widest_radius;
            neck_closed_ = neck->radius < parameters_.boundary_integral.neck_closed_radius;
        }
        row.bud_height_nm = shape.height;
        row.membrane_area_nm2 = shape.area;
        row.bending_energy_pN_nm =
            2.0 * std::numbers::pi * bending_energy(space, state, dynamics_.model(), Derivatives::first).energy;
        row.molecule_mass_nm2 = shape.mass;
        MaterialRates strain_rates = strain_.rates(accepted);
        strain_.advance(strain_rates_, strain_rates, integrator.time() - time_before);
        strain_rates_ = std::move(strain_rates);
        row.area_strain_max = strain_.largest();
        row.volume_extracellular_nm3 = shape.extracellular_volume;
        row.extra = own_columns(integrator, accepted, shape);
        output_.record_step(row);
    }

    std::vector<double> own_columns(const StiffIntegrator& integrator, const Evaluation& accepted,
                                    const ShapeIntegrals& shape) const {
        const Eigen::VectorXd walls = dynamics_.box().wall_unknowns(accepted.operators, accepted.flow);
        const FlowBalances flow =
            flow_balances(dynamics_.space(), dynamics_.box(), accepted.samples, accepted.flow, walls);
        const EnergyBalance energy = energy_balance(dynamics_, accepted);
        return {energy.dissipated_power,
                energy.energy_rate,
                energy.residual(),
                flow.force,
                flow.net_flux,
                flow.area,
                accepted.flow.inflow,
                shape.wall_distance,
                static_cast<double>(integrator.statistics().order)};
    }

    void check_walls(const ShapeIntegrals& shape, double time) const {
        if (shape.wall_distance >= parameters_.domain.wall_clearance) return;
        throw SolverError("membrane-near-wall",
                          "the membrane is " + std::to_string(shape.wall_distance) + " nm from a wall at t = " +
                              std::to_string(time) + " us, nearer than domain.wall_clearance",
                          "enlarge domain.height or move domain.membrane_height");
    }

    double output_time(double count) const { return count * parameters_.output.shape_interval; }

    void write_first_shape() { write_shape(0.0, start_.y); }

    void write_shapes(const StiffIntegrator& integrator) {
        while (output_time(memory_.shapes_written) <= integrator.time()) {
            const double time = output_time(memory_.shapes_written);
            write_shape(time, time < integrator.time() ? integrator.state_at(time) : integrator.state());
        }
    }

    void write_shape(double time, const Eigen::VectorXd& y) {
        const PhaseTimer timer(output_, "shapes");
        const MembraneSpace& space = dynamics_.space();
        output_.write_shape(time,
                            membrane_curve(space, dynamics_.evaluate(y), shape_points_per_element * space.elements()));
        memory_.shapes_written += 1.0;
    }

    FieldIndex field_index() const {
        const RunDirectory directory{output_.directory()};
        return output_.restart_point() ? FieldIndex(directory, start_.time) : FieldIndex(directory);
    }

    // The first multiple of output.field_interval after the fields written so far and after a restart's beginning.
    double next_field_time() const {
        if (!fields_.latest() && !output_.restart_point()) return 0.0;
        const double interval = parameters_.output.field_interval;
        const double done = std::max(start_.time, fields_.latest().value_or(0.0));
        const double count = std::floor(done / interval) + 1.0;
        return (count * interval > done ? count : count + 1.0) * interval;
    }

    void write_fields(const StiffIntegrator& integrator) {
        if (parameters_.output.field_interval <= 0.0) return;
        for (double time = next_field_time(); time <= integrator.time(); time = next_field_time()) {
            const PhaseTimer timer(output_, "fields");
            const Evaluation evaluation =
                dynamics_.evaluate(time < integrator.time() ? integrator.state_at(time) : integrator.state());
            fields_.add(time, vtu_text(field_grid(parameters_, dynamics_, evaluation,
                                                  parameters_.boundary_integral.field_spacing)));
        }
    }

    void record_budding(const StiffIntegrator& integrator) {
        memory_.budded = 1.0;
        const MembraneState state = dynamics_.unpack(integrator.state());
        const ShapeIntegrals shape = shape_integrals(dynamics_.space(), state, parameters_.domain);
        const auto neck = find_neck(dynamics_.space(), state);
        output_.record_event("budding", integrator.time(),
                             {{"neck_radius_nm", neck ? neck->radius : 0.0},
                              {"bud_diameter_nm", neck ? 2.0 * neck->widest_radius : 0.0},
                              {"bud_height_nm", shape.height},
                              {"membrane_area_nm2", shape.area}});
    }

    ExitReason stop(const StiffIntegrator& integrator, ExitReason reason) {
        output_.write_checkpoint(make_checkpoint(integrator.time(), integrator.state(), strain_, memory_));
        const auto statistics = integrator.statistics();
        output_.note("integrator", {{"steps", statistics.steps},
                                    {"rate_evaluations", statistics.rate_evaluations},
                                    {"jacobians", statistics.jacobians},
                                    {"error_test_failures", statistics.error_test_failures},
                                    {"convergence_failures", statistics.convergence_failures}});
        output_.note("unknowns", dynamics_.size());
        output_.note("wall_unknowns", dynamics_.box().walls().unknowns());
        return reason;
    }
};

}  // namespace

EngineIdentity identity() {
    EngineIdentity identity;
    identity.name = "boundary-integral";
    identity.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    identity.libraries = {{"sundials", SUNDIALS_VERSION},
                          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                                        "." + std::to_string(EIGEN_MINOR_VERSION)}};
    identity.history_columns = {"dissipated_power_pN_nm_per_us",
                                "energy_rate_pN_nm_per_us",
                                "energy_balance_relative",
                                "force_balance_relative",
                                "net_flux_relative",
                                "area_balance_relative",
                                "inflow_nm_per_us",
                                "wall_distance_nm",
                                "integrator_order"};
    return identity;
}

ExitReason simulate(const Parameters& parameters, RunOutput& output) {
    if (parameters.fluid.dynamics != Dynamics::flow) {
        throw InputError("fluid.dynamics: the boundary-integral engine offers \"flow\"");
    }
    if (parameters.fluid.inertia) {
        throw InputError("fluid.inertia: the boundary-integral engine solves the Stokes equations; set it to false");
    }
    // Our own threads share the work; those of OpenBLAS would only spin beside them on matrices of this size.
    openblas_set_num_threads(1);
    return Run(parameters, output).execute();
}

}  // namespace endoflow::boundary_integral
