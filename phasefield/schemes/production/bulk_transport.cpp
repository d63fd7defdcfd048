#include "phasefield/schemes/production/bulk_transport.h"

#include <cmath>
#include <numeric>
#include <utility>

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

Vector BulkTransport::combined(const std::vector<double>& weights) const {
    Vector out = space_.vector();
    for (std::size_t j = 0; j < weights.size(); ++j) out.add(weights[j], solutions_[j]);
    out.update_ghost_values();
    return out;
}

Vector BulkTransport::solve(const BulkStep& step, BulkExchange exchange) {
    assemble_bulk(problem(step), exchange, combined(step.bdf.past), system_);
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
    transfer_ = std::make_unique<Transfer>(space_.dofs);
    std::vector<const Vector*> vectors;
    for (const auto& solution : solutions_) vectors.push_back(&solution);
    transfer_->prepare_for_coarsening_and_refinement(vectors);
}

void BulkTransport::after_adaptation() {
    distribute();
    std::vector<Vector> carried(solutions_.size(), space_.vector());
    std::vector<Vector*> targets;
    for (auto& vector : carried) targets.push_back(&vector);
    transfer_->interpolate(targets);
    transfer_.reset();
    for (auto& vector : carried) {
        space_.hanging_nodes.distribute(vector);
        vector.update_ghost_values();
    }
    solutions_ = std::move(carried);
}

void BulkTransport::save(Checkpoint& checkpoint, const std::shared_ptr<const BulkSupply>& of_factors) {
    checkpoint.arrays["bulk_missing"] = missing_;
    checkpoint.arrays["bulk_made_up"] = made_up_;
    checkpoint.scalars["bulk_first_mass"] = first_mass_;
    checkpoint.scalars["bulk_corrected"] = corrected_;
    checkpoint.scalars["bulk_of_factors"] = of_factors ? 1 : 0;
    transfer_ = std::make_unique<Transfer>(space_.dofs);
    std::vector<const Vector*> vectors;
    for (const auto& solution : solutions_) vectors.push_back(&solution);
    if (of_factors) vectors.push_back(&of_factors->values);
    transfer_->prepare_for_serialization(vectors);
}

std::shared_ptr<const BulkSupply> BulkTransport::load(const Checkpoint& checkpoint) {
    missing_ = checkpoint.array("bulk_missing");
    made_up_ = checkpoint.array("bulk_made_up");
    first_mass_ = checkpoint.scalar("bulk_first_mass");
    corrected_ = checkpoint.scalar("bulk_corrected");
    distribute();
    renew();
    const bool with_factors = checkpoint.scalar("bulk_of_factors") != 0;
    solutions_.assign(missing_.size() + (with_factors ? 1 : 0), space_.vector());
    std::vector<Vector*> targets;
    for (auto& vector : solutions_) targets.push_back(&vector);
    Transfer transfer(space_.dofs);
    transfer.deserialize(targets);
    for (const auto& solution : solutions_) solution.update_ghost_values();
    if (!with_factors) return {};
    auto of_factors = supply_of(solutions_.back());
    solutions_.pop_back();
    return of_factors;
}

}  // namespace endoflow::phasefield::production
