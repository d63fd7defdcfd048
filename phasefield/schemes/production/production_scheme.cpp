#include "phasefield/schemes/production/production_scheme.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "phasefield/layer/boundary_flux.h"
#include "phasefield/layer/constants.h"
#include "phasefield/layer/initial_membrane.h"
#include "phasefield/schemes/production/external_loads.h"
#include "phasefield/schemes/production/refinement.h"
#include "shared/model/time_scale.h"
#include "shared/numerics/bdf.h"

namespace endoflow::phasefield::production {

namespace {

constexpr std::size_t line_points = 2;
constexpr unsigned int first_steps = highest_order + 1;  // before the error can be estimated well
constexpr double almost_all = constant("almost_all");
constexpr double newton_part = constant("newton_part");

/// A copy with ghost values: assignment alone could keep the ghosts of an earlier mesh.
Vector copied(const Vector& vector) {
    Vector out;
    out.reinit(vector, true);
    out = vector;
    out.update_ghost_values();
    return out;
}

}  // namespace

ProductionScheme::ProductionScheme(const Parameters& parameters, MPI_Comm communicator)
    : parameters_(parameters),
      case_(parameters),
      mesh_(coarse_mesh(parameters, communicator)),
      space_(*mesh_, field_degrees(parameters.phase_field)),
      solver_(parameters, communicator),
      bulk_(parameters.molecules.bulk == Bulk::none
                ? nullptr
                : std::make_unique<BulkTransport>(parameters, *mesh_, communicator)) {
    state_.next_step = first_implicit_step(parameters);
}

void ProductionScheme::distribute() {
    space_.distribute();
    close_constraints(space_, parameters_);
}

Contour ProductionScheme::contour(const Vector& solution) const {
    return extract_contour(contour_fields(space_, solution), parameters_);
}

double ProductionScheme::thickness_at(double r, double z) const {
    return state_.thickness ? state_.thickness->curve().at(r, z) : parameters_.phase_field.epsilon;
}

Vector ProductionScheme::polynomial(const std::vector<Vector>& solutions, double time, std::size_t count) const {
    return combination(space_, extrapolation_weights(time, state_.times, count), solutions);
}

StepNumbers ProductionScheme::at_rest() const {
    StepNumbers out(case_, 0);
    out.thickness = state_.thickness;
    out.molecules = state_.masses.front();
    if (bulk_) out.supply = bulk_->supply();
    return out;
}

std::vector<Vector> ProductionScheme::with_their_molecules(const StepNumbers& step) const {
    std::vector<Vector> out = state_.solutions;
    for (const auto& solution : out) solution.update_ghost_values();  // copies do not have them
    const auto now = molecules_of(space_, step, out);
    for (std::size_t j = 0; j < now.size(); ++j)
        if (now[j] > 0) scale_component(space_, molecule_density, state_.masses[j] / now[j], out[j]);
    return out;
}

void ProductionScheme::balance_molecules(const BdfCoefficients& bdf, SolutionMeasures& measures,
                                         Vector& solution) const {
    double& molecules = measures.integrals.molecules;
    if (molecules <= 0) return;
    const double before = std::inner_product(bdf.past.begin(), bdf.past.end(), state_.masses.begin(), 0.0);
    const double balanced = (measures.diagnostics.exchange_rate - before) / bdf.rate;
    measures.diagnostics.molecules_put_right = balanced - molecules;
    scale_component(space_, molecule_density, balanced / molecules, solution);
    molecules = balanced;
}

StepOutcome ProductionScheme::present() {
    const Vector& solution = state_.solutions.front();
    const auto measures = measure_solution(space_, LayerEnergy(parameters_, state_.times.front()), at_rest(), solution);
    StepOutcome out{measures.diagnostics, contour(solution), {}};
    state_.integrals = measures.integrals;
    state_.membrane = out.contour.curve;
    return out;
}

StepOutcome ProductionScheme::start() {
    const MembraneCurve curve = InitialMembrane(parameters_).curve(0.25 * parameters_.phase_field.cell_size);
    while (flag_bands(*mesh_, refined_bands(curve, parameters_))) mesh_->execute_coarsening_and_refinement();
    distribute();

    state_.solutions = {initial_fields(space_, parameters_, membrane_energy(parameters_))};
    state_.solutions.front().update_ghost_values();
    state_.times = {0};
    state_.masses = molecules_of(space_, StepNumbers(case_, 0), state_.solutions);
    BulkMeasures bulk;
    if (bulk_) {
        const StepNumbers numbers(case_, 0);
        const BdfCoefficients none{};
        bulk = bulk_->start({space_, LayerEnergy(parameters_), numbers, none, state_.solutions.front()},
                            state_.masses.front());
    }
    StepOutcome out = present();
    solver_.reinit(space_, state_.membrane);
    if (bulk_) out.diagnostics.bulk = bulk;
    return out;
}

double ProductionScheme::step(double time, double deadline) const {
    const double left = deadline - time, planned = state_.next_step;
    if (planned >= almost_all * left) return left;
    return planned >= 0.5 * left ? 0.5 * left : planned;  // no tiny last step
}

StepNumbers ProductionScheme::foreseen(double tau, const BdfCoefficients& bdf, double end) const {
    StepNumbers out = state_.steps > 0 ? StepNumbers(case_, bdf.rate, state_.speed) : StepNumbers(case_, bdf.rate);
    if (parameters_.phase_field.production.thinning > 0)
        out.thickness = thickness_on(*mesh_, ThicknessCurve(state_.membrane, tau, parameters_));
    out.maturation_rate = case_.maturation.rate(end);
    const auto ahead = extrapolation_weights(end, state_.times, std::min(state_.order() + 1, state_.times.size()));
    out.molecules = std::inner_product(ahead.begin(), ahead.end(), state_.masses.begin(), 0.0);
    if (case_.loads.coat_force != 0) out.coat_force = case_.loads.coat_force / out.molecules;
    return out;
}

StepOutcome ProductionScheme::attempt(double time, double tau) {
    const double end = time + tau;
    const std::size_t order = state_.order(), known = std::min(order + 1, state_.times.size());
    const auto bdf = bdf_coefficients(end, state_.times, order);
    trial_.reset();
    Trial trial{foreseen(tau, bdf, end), {}, {}, {}, 0, {}};
    StepNumbers& numbers = trial.numbers;
    const LayerEnergy energy(parameters_, end);
    trial.before = with_their_molecules(numbers);
    const Vector predicted = polynomial(trial.before, end, known);
    if (numbers.loads.on_material())
        numbers.material_force = std::make_shared<const MaterialForce>(contour(predicted).curve, numbers.loads);
    // Extrapolation of higher order would amplify what little the fields go back and forth in the layer's tails: with
    // the moment's noise, whose alignment is quadratic in it, Newton's first step would throw the whole bud off course.
    Vector guess = polynomial(trial.before, end, std::min(line_points, known));
    impose_boundary_values(space_, parameters_, guess);
    trial.solution = copied(guess);
    if (bulk_) numbers.supply = bulk_->foresee({space_, energy, numbers, bdf, guess});
    const StepPast past(space_, numbers, trial.before, bdf.past, extrapolation_weights(end, state_.times, order),
                        guess);
    const StepProblem problem{space_, energy, numbers, past};
    const unsigned int factorisations = solver_.factors().made();
    const double of_position = position_tolerance(parameters_), allowed = early_part(end, parameters_) * of_position;
    solver_.solve(problem, trial.solution, newton_part * allowed);
    const bool hard = solver_.factors().made() > factorisations + 1;

    Vector rate = combination(space_, bdf.past, trial.before);
    rate.zero_out_ghost_values();
    rate.add(bdf.rate, trial.solution);
    rate.update_ghost_values();
    auto measures = measure_solution(space_, energy, numbers, trial.before.front(), predicted, rate, trial.solution);
    balance_molecules(bdf, measures, trial.solution);
    auto& diagnostics = measures.diagnostics;
    diagnostics.net_vertical_force = net_vertical_force(problem, trial.solution);
    diagnostics.extracellular_inflow = extracellular_inflow(
        space_, trial.solution, velocity_r, velocity_z, distance,
        [epsilon = parameters_.phase_field.epsilon](double psi) { return equilibrium_profile(psi, epsilon); });
    diagnostics.load_power = load_power(problem, trial.solution);
    trial.integrals = measures.integrals;
    trial.layer_motion = measures.layer_motion;
    const double mass = measures.integrals.molecules;
    if (bulk_) diagnostics.bulk = bulk_->take({space_, energy, numbers, bdf, trial.solution}, state_.masses, mass, tau);

    const double tolerance = step_tolerance(parameters_);
    const double fraction = known > order ? error_fraction(end, state_.times, order) : 0;
    TriedStep& tried = trial.tried;
    tried.tau = tau;
    tried.order = order;
    tried.early = state_.steps < first_steps;
    tried.wrong_position = fraction * measures.step_difference / allowed;
    // A bulk that is being depleted changes the rate at which molecules come in times of its own.
    if (bulk_) tried.wrong_molecules = fraction * std::abs(mass / numbers.molecules - 1) / tolerance;
    tried.motion = measures.layer_motion / (largest_motion * parameters_.phase_field.epsilon);
    tried.change = std::max(measures.layer_motion / of_position, tau * measures.molecules_rate / tolerance);
    tried.hard = hard;
    tried.finite = std::isfinite(diagnostics.bending_energy);
    StepOutcome outcome{diagnostics, {}, rejection(tried)};
    if (outcome.rejection.empty()) outcome.contour = contour(trial.solution);
    trial_ = std::move(trial);
    return outcome;
}

void ProductionScheme::keep(double time, double tau, const StepOutcome& outcome) {
    Trial& trial = *trial_;
    state_.solutions = std::move(trial.before);
    state_.solutions.insert(state_.solutions.begin(), std::move(trial.solution));
    state_.times.insert(state_.times.begin(), time + tau);
    state_.masses.insert(state_.masses.begin(), trial.integrals.molecules);
    if (state_.times.size() > highest_order + 1) {
        state_.solutions.pop_back();
        state_.times.pop_back();
        state_.masses.pop_back();
    }
    for (const auto& solution : state_.solutions) solution.update_ghost_values();
    if (bulk_) bulk_->keep(highest_order + 1);
    if (!case_.exchange.none() || energetically_coupled(parameters_.molecules))
        state_.moved += edge_motion(state_.membrane, outcome.contour.curve);
    state_.moved += trial.layer_motion;
    state_.thickness = trial.numbers.thickness;
    state_.integrals = trial.integrals;
    state_.membrane = outcome.contour.curve;
    state_.speed = outcome.diagnostics.motion_max / tau;
    state_.next_step = step_after(trial.tried, state_.next_step, parameters_);
    state_.steps += 1;
    trial_.reset();
}

void ProductionScheme::reject(double time, double tau) {
    TriedStep tried = trial_ ? trial_->tried : TriedStep();
    tried.tau = tau;
    trial_.reset();
    state_.next_step = step_instead(tried, time, parameters_);
}

void ProductionScheme::place_collar(double area) {
    case_.loads.collar_place = area;
    state_.solutions.resize(1);
    state_.times.resize(1);
    state_.masses.resize(1);
    if (bulk_) bulk_->start_anew();
    state_.next_step = std::min(state_.next_step, first_implicit_step(parameters_));
    state_.steps = 0;
}

std::vector<NamedNumber> ProductionScheme::constants() const {
    std::vector<NamedNumber> out;
    for (const auto& row : constant_table) out.push_back({std::string(row.name), row.value});
    return out;
}

std::vector<NamedNumber> ProductionScheme::solver_counts() const {
    const auto row = [](const char* name, auto count) { return NamedNumber{name, static_cast<double>(count)}; };
    const StepFactors& factors = solver_.factors();
    return {row("iterations", solver_.iterations()), row("factorisations", factors.made()),
            row("factorisations_of_double_precision", factors.made_in_full_precision()),
            row("single_precision_failed", solver_.single_precision_failed()),
            row("unknowns_between_processes", factors.shared_unknowns())};
}

}  // namespace endoflow::phasefield::production
