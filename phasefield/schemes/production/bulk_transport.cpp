#include "phasefield/schemes/production/bulk_transport.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "shared/output/checkpoint_archive.h"

namespace endoflow::phasefield::production {

namespace {

/// Σ_j weights[j] values[j].
double weighted(const std::vector<double>& weights, const std::vector<double>& values) {
    return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
}

std::vector<unsigned int> bulk_degrees(const PhaseFieldParameters& p) {
    return std::vector<unsigned int>(n_bulk_fields, static_cast<unsigned int>(p.surface_degree));
}

}  // namespace

BulkTransport::BulkTransport(const Parameters& p, const Mesh& mesh, MPI_Comm communicator)
    : numbers_(p.molecules), space_(mesh, bulk_degrees(p.phase_field)), system_(communicator, "bulk") {}

void BulkTransport::distribute() {
    space_.distribute();
    space_.constraints.close();
}

void BulkTransport::renew() {
    Couplings couplings(n_bulk_fields, n_bulk_fields);
    couplings.fill(dealii::DoFTools::always);
    system_.reinit(space_, couplings);
}

BulkMeasures BulkTransport::start(const BulkStep& at_rest, double membrane_mass) {
    distribute();
    renew();
    solutions_ = {space_.vector()};
    solutions_.front().update_ghost_values();
    missing_ = made_up_ = {0};
    first_mass_ = membrane_mass;
    BulkMeasures out;
    out.molecules = integrate_bulk(problem(at_rest), solutions_.front()).molecules;
    return out;
}

BulkProblem BulkTransport::problem(const BulkStep& step) const {
    return {&space_, &numbers_, &step.space, &step.membrane, &step.energy, &step.numbers};
}

Vector BulkTransport::solve(const BulkStep& step, BulkExchange exchange) {
    assemble_bulk(problem(step), exchange, combination(space_, step.bdf.past, solutions_), system_);
    system_.forget_factors();  // a continued run then does the same
    Vector out = space_.vector();
    system_.solve(space_.constraints, out);
    return out;
}

std::shared_ptr<const BulkSupply> BulkTransport::foresee(const BulkStep& step) {
    return supply_of(solve(step, BulkExchange::implicit));
}

/// Molecules are counted by BDF, too: with m = ∫ c dA, p = a₀c_∞ ∫ χd and f what the walls make up for, the derivative
/// of m − p − f is to vanish. What is not right after the solve is the difference of j under δ and under δ_Γ, of the
/// order of ε², what Newton's method has left of m, and what the layer's motion and a new mesh have made of ∫ χd. A
/// uniform j makes up for it, at the membrane, where it has come from.
BulkMeasures BulkTransport::take(const BulkStep& step, const std::vector<double>& masses, double mass, double tau) {
    const auto& [rate, past] = step.bdf;
    Vector found = solve(step, BulkExchange::given);
    assemble_unit_exchange(problem(step), system_);
    Vector unit = space_.vector();
    system_.solve(space_.constraints, unit);

    const BulkIntegrals of_unit = integrate_bulk(problem(step), unit), before = integrate_bulk(problem(step), found);
    const double came = rate * mass + weighted(past, masses);
    const double wrong = came - rate * before.missing - weighted(past, missing_) - before.leaving;
    const double correction = wrong / (rate * of_unit.missing + of_unit.leaving);
    found.zero_out_ghost_values();
    found.add(correction, unit);
    found.update_ghost_values();
    trial_.reinit(found, true);  // assignment alone could keep the ghosts of an earlier mesh
    trial_ = found;

    const BulkIntegrals now = integrate_bulk(problem(step), found);
    trial_missing_ = now.missing;
    trial_made_up_ = (now.leaving - weighted(past, made_up_)) / rate;
    trial_corrected_ = corrected_ + tau * std::abs(correction) * now.area;
    return {now.molecules, now.at_membrane / now.area,
            std::abs(mass - trial_missing_ - trial_made_up_ - first_mass_) / first_mass_, trial_made_up_,
            trial_corrected_};
}

void BulkTransport::start_anew() {
    solutions_.resize(1);
    missing_.resize(1);
    made_up_.resize(1);
}

void BulkTransport::keep(std::size_t most) {
    solutions_.insert(solutions_.begin(), trial_);
    missing_.insert(missing_.begin(), trial_missing_);
    made_up_.insert(made_up_.begin(), trial_made_up_);
    corrected_ = trial_corrected_;
    if (solutions_.size() > most) {
        solutions_.pop_back();
        missing_.pop_back();
        made_up_.pop_back();
    }
    for (const auto& solution : solutions_) solution.update_ghost_values();  // copies do not have them
}

std::shared_ptr<const BulkSupply> BulkTransport::supply_of(const Vector& solution) const {
    auto out = std::make_shared<BulkSupply>(BulkSupply{&space_, solution});
    out->values.update_ghost_values();
    return out;
}

std::shared_ptr<const BulkSupply> BulkTransport::supply() const {
    return supply_of(solutions_.front());
}

void BulkTransport::before_adaptation() {
    transfer_ = MeshTransfer::for_adaptation(space_, solutions_);
}

void BulkTransport::after_adaptation() {
    distribute();
    solutions_ = transfer_->adapted(space_);
    transfer_.reset();
}

void BulkTransport::save(Checkpoint& checkpoint) {
    serialize(CheckpointWriter(checkpoint));
    transfer_ = MeshTransfer::for_saving(space_, solutions_);
}

void BulkTransport::load(const Checkpoint& checkpoint) {
    serialize(CheckpointReader(checkpoint));
    distribute();
    renew();
    solutions_ = MeshTransfer::loaded(space_, missing_.size());
}

}  // namespace endoflow::phasefield::production
