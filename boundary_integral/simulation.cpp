#include "boundary_integral/simulation.h"

#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boundary_integral/evolution/material_strain.h"
#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/evolution/stiff_integrator.h"
#include "boundary_integral/fields/field_grid.h"
#include "boundary_integral/flow/free_space_flow.h"
#include "boundary_integral/support/parallel.h"
#include "shared/geometry/observables.h"
#include "shared/output/field_index.h"
#include "shared/output/output_times.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::boundary_integral {

namespace {

constexpr Index shape_points_per_element = 8;
constexpr double smallest_step = 1e-14;  // us

// What the run remembers beside the integrator's history and the markers.
struct RunMemory {
    double last_row = 0.0;     // time of the last row of the history, us
    double last_shape = -1.0;  // time of the last shape; negative before the first one
    double budded = 0.0;       // 1 once the budding event is recorded
};

std::vector<double> as_array(const Eigen::MatrixXd& matrix) {
    return {matrix.data(), matrix.data() + matrix.size()};
}

class Run {
  public:
    Run(const Parameters& parameters, RunOutput& output)
        : parameters_(parameters),
          output_(output),
          dynamics_(parameters),
          strain_(dynamics_.space()),
          sampler_(dynamics_.space(), shape_points_per_element * dynamics_.space().elements()),
          initial_(dynamics_.initial_vector()),
          integrator_(problem(), restore(), {parameters.time.max_step, smallest_step}),
          fields_(field_index()) {}

    ExitReason execute() {
        if (memory_.last_shape < 0.0) write_shape(0.0, integrator_.state());
        if (!output_.restart_point()) write_fields();
        while (integrator_.time() < parameters_.time.end) {
            resume_ = make_checkpoint();
            if (interruption_signal() != 0) return stop(ExitReason::interrupted);
            if (output_.checkpoint_due()) output_.write_checkpoint(resume_);
            advance();
            write_shapes();
            write_fields();
            if (const auto reason = record_events()) return stop(*reason);
            record(integrator_.time(), dynamics_.evaluate(integrator_.state(), operators_));
        }
        return stop(ExitReason::done);
    }

  private:
    const Parameters& parameters_;
    RunOutput& output_;
    MembraneDynamics dynamics_;
    RunMemory memory_;
    MaterialStrain strain_;
    CurveSampler sampler_;
    Eigen::VectorXd initial_;
    MaterialRates strain_rates_;                          // at the last row
    std::shared_ptr<const MobilityOperators> operators_;  // of the step's predicted shape
    Evaluation latest_;                                   // of the last rate the integrator asked for
    StiffIntegrator integrator_;
    FieldIndex fields_;
    Checkpoint resume_;  // of the time before the last step
    long rejected_ = 0;

    double start_time() const { return output_.restart_point() ? output_.restart_point()->time_us : 0.0; }

    // The last step may have been cut short by time.end or end at an event: the checkpoint of the time before it lets a
    // restart make the steps that a run without this end makes.
    Checkpoint make_checkpoint() const {
        const StepHistory& history = integrator_.history();
        Checkpoint checkpoint;
        checkpoint.time_us = history.time;
        checkpoint.scalars = {{"next_step", history.step},          {"order", history.order},
                              {"equal_steps", history.equal_steps}, {"last_row", memory_.last_row},
                              {"last_shape", memory_.last_shape},   {"budded", memory_.budded}};
        checkpoint.arrays = {{"differences", as_array(history.differences)},
                             {"marker_xi", strain_.markers().xi},
                             {"marker_log_growth", strain_.markers().log_growth},
                             {"marker_drift_rate", strain_rates_.drift},
                             {"marker_growth_rate", strain_rates_.growth}};
        return checkpoint;
    }

    StepHistory restore() {
        const auto& checkpoint = output_.restart_point();
        if (!checkpoint) {
            const Evaluation start = dynamics_.evaluate(initial_);
            strain_rates_ = strain_.rates(start);
            return StepHistory::start(0.0, parameters_.time.initial_step, initial_, start.rate);
        }
        StepHistory history;
        const std::vector<double>& differences = checkpoint->array("differences");
        constexpr Index columns = StepHistory::highest_order + 3;
        if (static_cast<Index>(differences.size()) != dynamics_.size() * columns) {
            throw IoError("the checkpoint in " + output_.directory().string() +
                          " does not hold this membrane; run without --restart");
        }
        history.time = checkpoint->time_us;
        history.step = checkpoint->scalar("next_step");
        history.order = static_cast<int>(checkpoint->scalar("order"));
        history.equal_steps = static_cast<int>(checkpoint->scalar("equal_steps"));
        history.differences = Eigen::Map<const Eigen::MatrixXd>(differences.data(), dynamics_.size(), columns);
        memory_ = {checkpoint->scalar("last_row"), checkpoint->scalar("last_shape"), checkpoint->scalar("budded")};
        strain_.restore({checkpoint->array("marker_xi"), checkpoint->array("marker_log_growth")});
        strain_rates_ = {checkpoint->array("marker_drift_rate"), checkpoint->array("marker_growth_rate")};
        return history;
    }

    StiffProblem problem() {
        StiffProblem problem;
        problem.begin_step = [this](const Eigen::VectorXd& predicted) {
            const PhaseTimer timer(output_, "flow operators");
            operators_ = dynamics_.operators(predicted);
        };
        problem.rate = [this](const Eigen::VectorXd& y) {
            const PhaseTimer timer(output_, "rates");
            latest_ = dynamics_.evaluate(y, operators_);
            return latest_.rate;
        };
        problem.jacobian = [this] {
            const PhaseTimer timer(output_, "Jacobians");
            return dynamics_.jacobian(latest_);
        };
        // One unit of error: time.tolerance nm in the curve, time.tolerance in the concentration.
        problem.error_scales =
            dynamics_.error_scales(dynamics_.initial_vector(), parameters_.time.tolerance, parameters_.time.tolerance);
        return problem;
    }

    void advance() {
        integrator_.advance(parameters_.time.end);
        const auto& statistics = integrator_.statistics();
        const long rejected = statistics.error_test_failures + statistics.convergence_failures;
        for (; rejected_ < rejected; ++rejected_) output_.count_rejected_step();
    }

    // A row of the history. After a step `accepted` holds the flow that made it.
    void record(double time, const Evaluation& accepted) {
        const PhaseTimer timer(output_, "observables");
        const MembraneSpace& space = dynamics_.space();
        const MembraneState& state = accepted.state;
        const ShapeIntegrals shape = shape_integrals(space, state, parameters_.domain);
        check_walls(shape, time);
        check_stiffness(accepted.samples.c, time);
        const auto neck = find_neck(space, state);
        HistoryRow row;
        row.time_us = time;
        row.step_us = time - memory_.last_row;
        if (neck) {
            row.neck_radius_nm = neck->radius;
            row.bud_diameter_nm = 2.0 * neck->widest_radius;
        }
        row.bud_height_nm = shape.height;
        row.membrane_area_nm2 = shape.area;
        row.bending_energy_pN_nm = 2.0 * std::numbers::pi * accepted.energy.energy;
        row.molecule_mass_nm2 = shape.mass;
        MaterialRates strain_rates = strain_.rates(accepted);
        strain_.advance(strain_rates_, strain_rates, row.step_us);
        strain_rates_ = std::move(strain_rates);
        row.area_strain_max = strain_.largest();
        row.volume_extracellular_nm3 = shape.extracellular_volume;
        row.extra = own_columns(accepted, shape);
        output_.record_step(row);
        memory_.last_row = time;
    }

    std::vector<double> own_columns(const Evaluation& accepted, const ShapeIntegrals& shape) const {
        const FlowBalances flow = balances(accepted);
        const EnergyBalance energy = energy_balance(dynamics_, accepted);
        return {energy.dissipated_power,
                energy.energy_rate,
                energy.residual(),
                flow.force,
                flow.net_flux,
                flow.area,
                accepted.flow.inflow,
                shape.wall_distance,
                static_cast<double>(integrator_.last_order())};
    }

    // All zero without a fluid.
    FlowBalances balances(const Evaluation& accepted) const {
        if (accepted.flow.force.size() == 0) return {};
        if (const BoxFlow* box = dynamics_.box()) {
            return flow_balances(dynamics_.space(), *box, *accepted.operators, accepted.samples, accepted.flow);
        }
        return flow_balances(dynamics_.space(), *accepted.operators, accepted.samples, accepted.flow);
    }

    void check_walls(const ShapeIntegrals& shape, double time) const {
        if (parameters_.domain.kind != DomainKind::box || shape.wall_distance >= parameters_.domain.wall_clearance)
            return;
        throw SolverError("membrane-near-wall",
                          "the membrane is " + std::to_string(shape.wall_distance) + " nm from a wall at t = " +
                              std::to_string(time) + " us, nearer than domain.wall_clearance",
                          "enlarge domain.height or move domain.membrane_height");
    }

    // Beside the coat's edge c leaves [0, 1] by some hundredths. That is harmless as long as b(c) stays positive;
    // bending with a negative stiffness is ill-posed, and no time step would be small enough.
    void check_stiffness(const std::vector<double>& concentrations, double time) const {
        for (const double c : concentrations) {
            if (dynamics_.model().stiffness(c).value > 0.0) continue;
            throw SolverError(
                "negative-stiffness",
                "the law of membrane.constitutive_law gives no positive bending stiffness at c = " + std::to_string(c) +
                    ", beside the edge of the coat, at t = " + std::to_string(time) + " us",
                "bring membrane.bending_stiffness and bending_stiffness_coated nearer to each other, or "
                "choose another membrane.constitutive_law");
        }
    }

    // Multiples after a restart's beginning: with another interval than before it, those before it are past.
    double next_shape_time() const {
        return next_multiple(parameters_.output.shape_interval, std::max(start_time(), memory_.last_shape));
    }

    void write_shapes() {
        for (double time = next_shape_time(); reached(time); time = next_shape_time())
            write_shape(time, state_at(time));
    }

    bool reached(double time) const { return time <= integrator_.time() * (1.0 + same_time); }

    Eigen::VectorXd state_at(double time) const {
        return time < integrator_.time() ? integrator_.state_at(time) : integrator_.state();
    }

    void write_shape(double time, const Eigen::VectorXd& y) {
        const PhaseTimer timer(output_, "shapes");
        output_.write_shape(time, sampler_(dynamics_.evaluate(y)));
        memory_.last_shape = time;
    }

    FieldIndex field_index() const {
        const RunDirectory directory{output_.directory()};
        return output_.restart_point() ? FieldIndex(directory, start_time()) : FieldIndex(directory);
    }

    // After the fields written so far and after a restart's beginning.
    double next_field_time() const {
        if (!fields_.latest() && !output_.restart_point()) return 0.0;
        return next_multiple(parameters_.output.field_interval, std::max(start_time(), fields_.latest().value_or(0.0)));
    }

    void write_fields() {
        if (parameters_.output.field_interval <= 0.0 || dynamics_.box() == nullptr) return;
        for (double time = next_field_time(); reached(time); time = next_field_time()) {
            const PhaseTimer timer(output_, "fields");
            const Evaluation evaluation = dynamics_.evaluate(state_at(time));
            fields_.add(time, vtu_text(field_grid(parameters_, dynamics_, evaluation,
                                                  parameters_.boundary_integral.field_spacing)));
        }
    }

    // Events of the last step, each with a row of the history; says when one ends the run.
    std::optional<ExitReason> record_events() {
        const auto neck_radius = [this](const Eigen::VectorXd& y) {
            const auto neck = find_neck(dynamics_.space(), dynamics_.unpack(y));
            return neck ? neck->radius : std::numeric_limits<double>::infinity();
        };
        if (memory_.budded == 0.0) {
            if (const auto time = integrator_.falls_below(neck_radius, budding_neck_radius)) {
                memory_.budded = 1.0;
                record_event("budding", *time);
                if (parameters_.output.stop_at_budding) return ExitReason::budded;
            }
        }
        if (const auto time = integrator_.falls_below(neck_radius, parameters_.boundary_integral.neck_closed_radius)) {
            record_event("neck_closed", *time);
            return ExitReason::neck_closed;
        }
        return std::nullopt;
    }

    void record_event(const std::string& name, double time) {
        const Eigen::VectorXd y = state_at(time);
        if (time > memory_.last_row) record(time, dynamics_.evaluate(y));
        const MembraneState state = dynamics_.unpack(y);
        const ShapeIntegrals shape = shape_integrals(dynamics_.space(), state, parameters_.domain);
        const auto neck = find_neck(dynamics_.space(), state);
        output_.record_event(name, time,
                             {{"neck_radius_nm", neck ? neck->radius : 0.0},
                              {"bud_diameter_nm", neck ? 2.0 * neck->widest_radius : 0.0},
                              {"bud_height_nm", shape.height},
                              {"membrane_area_nm2", shape.area}});
    }

    ExitReason stop(ExitReason reason) {
        output_.write_checkpoint(resume_);
        const auto& statistics = integrator_.statistics();
        output_.note("integrator", {{"steps", statistics.steps},
                                    {"rate_evaluations", statistics.rates},
                                    {"jacobians", statistics.jacobians},
                                    {"error_test_failures", statistics.error_test_failures},
                                    {"convergence_failures", statistics.convergence_failures}});
        output_.note("unknowns", dynamics_.size());
        if (const BoxFlow* box = dynamics_.box()) output_.note("wall_unknowns", box->walls().unknowns());
        return reason;
    }
};

}  // namespace

EngineIdentity identity(const Parameters& parameters) {
    EngineIdentity identity;
    identity.name = "boundary-integral";
    identity.threads = thread_count(parameters.boundary_integral.threads);
    identity.libraries = {{"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
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
    identity.kept_parameters = {"domain.kind", "domain.radius", "domain.membrane_height", "boundary_integral.elements"};
    return identity;
}

ExitReason simulate(const Parameters& parameters, RunOutput& output) {
    if (parameters.fluid.inertia) {
        throw InputError("fluid.inertia: the boundary-integral engine solves the Stokes equations; set it to false");
    }
    const DomainParameters& domain = parameters.domain;
    if (domain.kind == DomainKind::free_space && parameters.fluid.dynamics == Dynamics::flow &&
        parameters.membrane.inextensible && domain.spheroid_polar_axis == domain.spheroid_equatorial_axis) {
        throw InputError(
            "domain.spheroid_polar_axis: an inextensible sphere keeps its shape; make it differ from "
            "domain.spheroid_equatorial_axis");
    }
    // Our own threads share the work; those of OpenBLAS would only spin beside them on matrices of this size.
    openblas_set_num_threads(1);
    return Run(parameters, output).execute();
}

}  // namespace endoflow::boundary_integral
