#include "phasefield/schemes/production/production_scheme.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "phasefield/layer/boundary_flux.h"
#include "phasefield/layer/initial_membrane.h"
#include "phasefield/output/field_file.h"
#include "phasefield/schemes/production/bdf.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/external_loads.h"
#include "phasefield/schemes/production/refinement.h"
#include "shared/model/time_scale.h"
#include "shared/support/error.h"

namespace endoflow::phasefield::production {

namespace {

constexpr std::size_t highest_order = count("highest_order");
constexpr std::size_t guess_points = count("guess_points");
constexpr double first_steps = constant("first_steps");
constexpr double default_tolerance = constant("default_tolerance");
constexpr double error_part = constant("error_part");
constexpr double safety = constant("safety");
constexpr double largest_growth = constant("largest_growth");
constexpr double after_hard_step = constant("after_hard_step");
constexpr double almost_all = constant("almost_all");
constexpr double tolerated_excess = constant("tolerated_excess");
constexpr double newton_part = constant("newton_part");
constexpr double smallest_step = constant("smallest_step");
constexpr double largest_motion = constant("largest_motion");
constexpr double longer_steps = constant("longer_steps");

/// Largest relative error of a step.
double step_tolerance(const Parameters& p) {
    return error_part * time_tolerance(p, default_tolerance);
}

/// The same of the membrane's position [nm], over the circumference of what forms.
double position_tolerance(const Parameters& p) {
    return step_tolerance(p) * 2 * std::numbers::pi * length_of_structure(p);
}

/// Longest step [µs] after one of `tau` in which membrane and molecules changed by so many of the errors that a step
/// may have: at rest, where they change by less, only the error limits it.
double longest(const Parameters& p, double tau, double change) {
    return p.time.max_step > 0 ? p.time.max_step : std::max(longer_steps * longest_step(p), tau / change);
}

}  // namespace

ProductionScheme::ProductionScheme(const Parameters& parameters, MPI_Comm communicator)
    : parameters_(parameters),
      energy_(parameters),
      mesh_(coarse_mesh(parameters, communicator)),
      space_(*mesh_, field_degrees(parameters.phase_field)),
      numbers_(parameters, membrane_weight(parameters.fluid, parameters.phase_field.viscosity_mean)),
      solver_(parameters, energy_, communicator, newton_part * position_tolerance(parameters)),
      bulk_(parameters.molecules.bulk == Bulk::none
                ? nullptr
                : std::make_unique<BulkTransport>(parameters, *mesh_, communicator)),
      nominal_(first_step(parameters)) {}

namespace {

/// φ and the pressure with the layer's part, which are not unknowns themselves.
class PhysicalFields : public dealii::DataPostprocessor<2> {
  public:
    explicit PhysicalFields(const StepNumbers& step) : step_(&step) {}
    [[nodiscard]] std::vector<std::string> get_names() const override { return {"phi", "pressure"}; }
    [[nodiscard]] std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override {
        return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
            2, dealii::DataComponentInterpretation::component_is_scalar);
    }
    [[nodiscard]] dealii::UpdateFlags get_needed_update_flags() const override {
        return dealii::update_values | dealii::update_quadrature_points;
    }
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        const auto cell = in.get_cell<2>();
        const CellBox box = cell_box(cell);
        for (std::size_t q = 0; q < out.size(); ++q) {
            const auto& value = in.solution_values[q];
            const double x = (in.evaluation_points[q][0] - box.r0) / box.hr;
            const double y = (in.evaluation_points[q][1] - box.z0) / box.hz;
            const double epsilon = step_->thickness_at(cell->active_cell_index(), box, x, y).value;
            out[q](0) = equilibrium_profile(value(distance), epsilon);
            out[q](1) = value(Field::pressure) + layer_profile(value(distance), epsilon).delta * value(pressure_layer);
        }
    }

  private:
    const StepNumbers* step_;
};

/// c_b [1/nm³], which means something where the fluid is that has it.
class BulkConcentration : public dealii::DataPostprocessorScalar<2> {
  public:
    explicit BulkConcentration(const MoleculeParameters& molecules)
        : dealii::DataPostprocessorScalar<2>("bulk_concentration", dealii::update_values),
          initial_(molecules.bulk_concentration) {}
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        for (std::size_t q = 0; q < out.size(); ++q) out[q](0) = initial_ * (1 - in.solution_values[q](depletion));
    }

  private:
    double initial_;
};

}  // namespace

void ProductionScheme::distribute() {
    space_.distribute();
    close_constraints(space_, parameters_);
}

void ProductionScheme::restore_molecules() {
    const auto now = molecules_of(space_, numbers_, solutions_);
    for (std::size_t j = 0; j < now.size(); ++j)
        if (now[j] > 0) scale_component(space_, molecule_density, masses_[j] / now[j], solutions_[j]);
}

void ProductionScheme::foresee_thickness(double tau) {
    if (parameters_.phase_field.production.thinning == 0) return;
    numbers_.thickness = thickness_on(*mesh_, ThicknessCurve(membrane_, tau, parameters_));
    restore_molecules();
}

double ProductionScheme::thickness_at(double r, double z) const {
    return numbers_.thickness ? numbers_.thickness->curve().at(r, z) : parameters_.phase_field.epsilon;
}

void ProductionScheme::renew() {
    distribute();
    solver_.reinit(space_);
}

Contour ProductionScheme::contour(const Vector& solution) const {
    return extract_contour(contour_fields(space_, solution), parameters_);
}

StepOutcome ProductionScheme::present() {
    const Vector& solution = solutions_.front();
    const auto measures = measure_solution(space_, energy_, numbers_, solution);
    integrals_ = measures.integrals;
    StepOutcome out{measures.diagnostics, contour(solution), {}};
    membrane_ = out.contour.curve;
    return out;
}

StepOutcome ProductionScheme::start() {
    const MembraneCurve curve = InitialMembrane(parameters_).curve(0.25 * parameters_.phase_field.cell_size);
    while (flag_bands(*mesh_, refined_bands(curve, parameters_))) mesh_->execute_coarsening_and_refinement();
    renew();

    const Vector solution = initial_fields(space_, parameters_, energy_.density);
    solutions_ = {solution};
    solutions_.front().update_ghost_values();
    times_ = {0};
    masses_ = molecules_of(space_, numbers_, solutions_);
    numbers_.molecules = masses_.front();
    StepOutcome out = present();
    const BdfCoefficients none{};
    if (bulk_)
        out.diagnostics.bulk = bulk_->start({space_, energy_, numbers_, none, solutions_.front()}, masses_.front());
    return out;
}

std::size_t ProductionScheme::order() const {
    return std::min(highest_order, times_.size());
}

double ProductionScheme::step(double time, double deadline) const {
    const double left = deadline - time;
    if (nominal_ >= almost_all * left) return left;
    return nominal_ >= 0.5 * left ? 0.5 * left : nominal_;  // no tiny last step
}

Vector ProductionScheme::polynomial(double time, std::size_t count) const {
    const auto weights = extrapolation_weights(time, times_, count);
    Vector out = space_.vector();
    for (std::size_t j = 0; j < weights.size(); ++j) out.add(weights[j], solutions_[j]);
    out.update_ghost_values();
    return out;
}

StepOutcome ProductionScheme::attempt(double time, double tau) {
    const double end = time + tau;
    if (since_start_ > 0) numbers_.move_at(speed_);
    foresee_thickness(tau);
    const auto bdf = bdf_coefficients(end, times_, order());
    numbers_.rate = bdf.rate;
    const std::size_t known = std::min(order() + 1, times_.size());
    const Vector predicted = polynomial(end, known);
    if (numbers_.loads.pole_force != 0)
        numbers_.pole_force = std::make_shared<const PoleForce>(contour(predicted).curve, numbers_.loads);
    const auto ahead = extrapolation_weights(end, times_, known);
    numbers_.molecules = std::inner_product(ahead.begin(), ahead.end(), masses_.begin(), 0.0);
    // Extrapolation of higher order would amplify what little the fields go back and forth in the layer's tails: with
    // the moment's noise, whose alignment is quadratic in it, Newton's first step would throw the whole bud off course.
    Vector guess = polynomial(end, std::min(guess_points, times_.size()));
    impose_boundary_values(space_, parameters_, guess);
    trial_.reinit(guess, true);  // assignment alone could keep the ghosts of an earlier mesh
    trial_ = guess;
    trial_.update_ghost_values();
    if (bulk_) numbers_.supply = bulk_->foresee({space_, energy_, numbers_, bdf, guess});
    const StepPast history(space_, numbers_, solutions_, bdf.past, extrapolation_weights(end, times_, order()), guess);
    const unsigned int factorisations = solver_.counts().factorisations;
    solver_.solve(space_, numbers_, history, trial_);
    const bool hard = solver_.counts().factorisations > factorisations + 1;

    Vector rate = space_.vector();
    rate.add(bdf.rate, trial_);
    for (std::size_t j = 0; j < bdf.past.size(); ++j) rate.add(bdf.past[j], solutions_[j]);
    rate.update_ghost_values();
    auto measures = measure_solution(space_, energy_, numbers_, solutions_.front(), predicted, rate, trial_);
    measures.diagnostics.net_vertical_force = net_vertical_force(space_, energy_, numbers_, history, trial_);
    measures.diagnostics.extracellular_inflow =
        extracellular_inflow(space_, trial_, velocity_r, velocity_z, distance,
                             [epsilon = widest_layer(parameters_, parameters_.domain.radius)](double psi) {
                                 return equilibrium_profile(psi, epsilon);
                             });
    measures.diagnostics.load_power = load_power(space_, numbers_, history, trial_);
    trial_integrals_ = measures.integrals;
    if (bulk_)
        measures.diagnostics.bulk =
            bulk_->take({space_, energy_, numbers_, bdf, trial_}, masses_, trial_integrals_.molecules, tau);
    trial_motion_ = measures.layer_motion;
    trial_change_ = std::max(trial_motion_ / position_tolerance(parameters_),
                             tau * measures.molecules_rate / step_tolerance(parameters_));
    const double farthest = largest_motion * parameters_.phase_field.epsilon;
    trial_factor_ = since_start_ < first_steps ? 1 : largest_growth;
    double wrong_position = 0, wrong_molecules = 0;  // errors of the step over those allowed
    if (times_.size() > order()) {
        const double fraction = error_fraction(end, times_, order());
        wrong_position = fraction * measures.step_difference / position_tolerance(parameters_);
        // A bulk that is being depleted changes the rate at which molecules come in times of its own.
        if (bulk_)
            wrong_molecules =
                fraction * std::abs(trial_integrals_.molecules / numbers_.molecules - 1) / step_tolerance(parameters_);
        const double larger = std::max(wrong_position, wrong_molecules);  // 0 lets the step grow as far as it may
        trial_factor_ = std::min(trial_factor_, safety * std::pow(larger, -1 / (1 + static_cast<double>(order()))));
    }
    if (trial_motion_ > 0) trial_factor_ = std::min(trial_factor_, safety * farthest / trial_motion_);
    if (hard && tau > longest_step(parameters_)) trial_factor_ = std::min(trial_factor_, after_hard_step);
    StepOutcome outcome{measures.diagnostics, {}, {}};
    if (!std::isfinite(measures.diagnostics.bending_energy))
        outcome.rejection = "the energy is not a number";
    else if (trial_motion_ > farthest)
        outcome.rejection = "motion of " + std::to_string(trial_motion_ / parameters_.phase_field.epsilon) + " ε";
    else if (wrong_position > tolerated_excess)
        outcome.rejection = "error of the position " + std::to_string(wrong_position) + " times the allowed one";
    else if (wrong_molecules > tolerated_excess)
        outcome.rejection = "error of the molecules " + std::to_string(wrong_molecules) + " times the allowed one";
    else
        outcome.contour = contour(trial_);
    return outcome;
}

void ProductionScheme::keep(double time, double tau, const StepOutcome& outcome) {
    solutions_.insert(solutions_.begin(), trial_);
    times_.insert(times_.begin(), time + tau);
    masses_.insert(masses_.begin(), trial_integrals_.molecules);
    if (times_.size() > highest_order + 1) {
        solutions_.pop_back();
        times_.pop_back();
        masses_.pop_back();
    }
    for (const auto& solution : solutions_) solution.update_ghost_values();  // copies do not have them
    if (bulk_) bulk_->keep(highest_order + 1);
    integrals_ = trial_integrals_;
    if (!numbers_.exchange.none() || energy_.coupled) moved_ += edge_motion(membrane_, outcome.contour.curve);
    membrane_ = outcome.contour.curve;
    // A step that was cut short by a deadline does not shorten the next one.
    const double next = trial_factor_ * tau;
    nominal_ = tau < nominal_ && trial_factor_ >= 1 ? std::max(nominal_, next) : next;
    nominal_ = std::min(nominal_, longest(parameters_, tau, trial_change_));
    speed_ = outcome.diagnostics.motion_max / tau;
    moved_ += trial_motion_;
    since_start_ += 1;
}

void ProductionScheme::reject(double time, double tau) {
    nominal_ = std::clamp(trial_factor_, 0.2, 0.5) * tau;
    trial_factor_ = 0;
    if (nominal_ < smallest_step * first_step(parameters_))
        throw SolverError("step-size-underflow", "no acceptable time step at t = " + std::to_string(time) + " µs",
                          "use a smaller phase_field.cell_size or a larger phase_field.production.profile_relaxation");
}

std::vector<NamedNumber> ProductionScheme::constants() const {
    std::vector<NamedNumber> out;
    for (const auto& row : production::constants) out.push_back({std::string(row.name), row.value});
    return out;
}

std::vector<NamedNumber> ProductionScheme::solver_counts() const {
    const auto& counts = solver_.counts();
    const auto row = [](const char* name, auto count) { return NamedNumber{name, static_cast<double>(count)}; };
    return {row("iterations", counts.iterations), row("factorisations", counts.factorisations),
            row("factorisations_of_double_precision", counts.of_double_precision),
            row("single_precision_failed", counts.single_precision_failed),
            row("unknowns_between_processes", solver_.shared_unknowns())};
}

void ProductionScheme::write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                                    double time) const {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    std::vector<Interpretation> meaning(n_fields, dealii::DataComponentInterpretation::component_is_scalar);
    meaning[velocity_r] = meaning[velocity_z] = dealii::DataComponentInterpretation::component_is_part_of_vector;
    std::vector<std::string> names;
    for (const auto& unknown : production::unknowns()) names.emplace_back(unknown.output_name);
    dealii::DataOut<2> data;
    const Vector solution = polynomial(time, times_.size());
    const PhysicalFields physical(numbers_);
    data.add_data_vector(space_.dofs, solution, names, meaning);
    data.add_data_vector(space_.dofs, solution, physical);
    Vector bulk;
    const BulkConcentration concentration(parameters_.molecules);
    if (bulk_) {
        bulk = bulk_->combined(extrapolation_weights(time, times_, times_.size()));
        data.add_data_vector(bulk_->space().dofs, bulk, concentration);
    }
    data.build_patches(space_.degrees[distance]);
    write_field_file(run_directory, times, time, mesh_->get_communicator(), data);
}

}  // namespace endoflow::phasefield::production
