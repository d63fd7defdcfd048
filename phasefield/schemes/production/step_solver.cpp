#include "phasefield/schemes/production/step_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "phasefield/fem/interruption.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/diagnostics.h"
#include "phasefield/schemes/production/thickness_checkpoint.h"
#include "phasefield/solver/anderson.h"
#include "shared/support/error.h"

namespace endoflow::phasefield::production {

namespace {

constexpr int most_iterations = count("most_iterations");
constexpr int seen_enough = count("seen_enough");
constexpr double farthest = constant("farthest");
constexpr unsigned int most_failures = count("most_failures");
constexpr int most_factorisations = count("most_factorisations");
constexpr double fast_contraction = constant("fast_contraction");
constexpr double largest_rest = constant("largest_rest");
constexpr double round_off = constant("round_off");
constexpr double most_divergence = constant("most_divergence");
constexpr std::size_t vectors_of_guess = 2;  // of an Origin, before the solutions

}  // namespace

bool StepSolver::Distrust::may_try() {
    if (steps_ == 0) return true;
    --steps_;
    return false;
}

void StepSolver::Distrust::note(bool failed) {
    failures_ = failed ? std::min(failures_ + 1, most_failures) : 0;
    steps_ = failures_ < 2 ? 0 : 1U << (failures_ - 2);
}

std::vector<double> StepSolver::Distrust::numbers() const {
    return {static_cast<double>(failures_), static_cast<double>(steps_)};
}

StepSolver::Distrust StepSolver::Distrust::from(const std::vector<double>& numbers) {
    Distrust out;
    out.failures_ = static_cast<unsigned int>(numbers.at(0));
    out.steps_ = static_cast<unsigned int>(numbers.at(1));
    return out;
}

StepSolver::StepSolver(const Parameters& parameters, const LayerEnergy& energy, MPI_Comm communicator, double wanted)
    : energy_(energy), pattern_(parameters, energy), system_(communicator, "coupled"), wanted_(wanted) {
    const Scales by = scales(parameters);
    for (const auto& unknown : unknowns()) least_.push_back(round_off * unknown.size(by));
}

void StepSolver::reinit(const Space& space) {
    system_.reinit(space);
    origin_ = {};
}

Vector StepSolver::factorise(const Problem& problem, const Vector& solution) {
    const auto& history = *problem.history;
    origin_ = {problem.numbers->rate,
               problem.numbers->speed,
               problem.numbers->molecules,
               problem.numbers->thickness,
               problem.numbers->pole_force,
               problem.numbers->supply,
               history.weights,
               history.ahead,
               {solution}};
    origin_.vectors.push_back(*history.extrapolated);
    for (std::size_t j = 0; j < history.weights.size(); ++j) origin_.vectors.push_back((*history.solutions)[j]);
    assemble(*problem.space, pattern_, energy_, *problem.numbers, history, solution, system_);
    Vector out = problem.space->vector();
    ++counts_.factorisations;
    if (system_.precision() == Precision::full) ++counts_.of_double_precision;
    system_.forget_factors();
    system_.solve(*problem.space, out);
    return out;
}

Vector StepSolver::increment(const Problem& problem, const Vector& solution) {
    assemble_residual(*problem.space, pattern_, energy_, *problem.numbers, *problem.history, solution, system_);
    Vector out = problem.space->vector();
    system_.apply_factors(*problem.space, out);
    return out;
}

StepSolver::Ending StepSolver::iterate(const Problem& problem, Vector& solution, const Vector* newton) {
    std::optional<AndersonMixing> mixing;
    double first = 0, last = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        give_up_if_interrupted(problem.space->dofs.get_communicator());
        ++counts_.iterations;
        const bool at_factors = iteration == 0 && newton != nullptr;
        const Vector step = at_factors ? *newton : increment(problem, solution);
        const double change = layer_increment(*problem.space, *problem.numbers, step, solution);
        char text[24];
        std::snprintf(text, sizeof text, at_factors ? " %.1e" : " (%.1e)", change);
        changes_ += text;
        if (iteration == 0) first = std::max(change, wanted_);
        if (!std::isfinite(change) || change > most_divergence * first) return Ending::diverged;
        if (!mixing) mixing.emplace(*problem.space, step, least_, presence(*problem.space, *problem.numbers, solution));
        mixing->advance(solution, step);
        const double contraction = change / last;
        const bool foreseen = newton != nullptr && iteration > 0 && contraction < fast_contraction;
        const bool arrived = change <= wanted_ || (foreseen && change * contraction <= 0.5 * wanted_);
        if (arrived && mixing->norm(step) <= largest_rest) return Ending::converged;
        if (iteration >= seen_enough &&
            std::log(wanted_ / first) < most_iterations * std::log(change / first) / iteration)
            break;  // it would take more at this rate
        last = change;
    }
    return Ending::slow;
}

bool StepSolver::near_factors(const Problem& problem, const Vector& solution) const {
    Vector moved = solution;
    moved -= origin_.vectors.front();
    moved.update_ghost_values();
    return layer_increment(*problem.space, *problem.numbers, moved, solution) <
           farthest * problem.numbers->numerics.epsilon;
}

StepSolver::Ending StepSolver::iterate_with_old_factors(const Problem& problem, Vector& solution) {
    if (!system_.has_factors() || !near_factors(problem, solution)) return Ending::slow;
    if (!distrust_of_old_.may_try()) return Ending::slow;
    Ending ending = Ending::diverged;
    try {
        ending = iterate(problem, solution, nullptr);
    } catch (const SolverError&) {  // new factors may serve
    }
    distrust_of_old_.note(ending != Ending::converged);
    return ending;
}

StepSolver::Ending StepSolver::iterate_with_new_factors(const Problem& problem, Vector& solution) {
    give_up_if_interrupted(problem.space->dofs.get_communicator());
    try {
        const Vector newton = factorise(problem, solution);
        return iterate(problem, solution, &newton);
    } catch (const SolverError&) {
        if (system_.precision() == Precision::full) throw;
        return Ending::diverged;
    }
}

void StepSolver::solve(const Space& space, const StepNumbers& numbers, const StepPast& history, Vector& solution) {
    const Origin before = origin_;
    const Distrust of_old = distrust_of_old_, of_single = distrust_of_single_;
    const Precision precision = system_.precision();
    try {
        converge({&space, &numbers, &history}, solution);
    } catch (const Interrupted&) {
        origin_ = before;
        distrust_of_old_ = of_old;
        distrust_of_single_ = of_single;
        system_.use(precision);
        throw;
    }
}

void StepSolver::converge(const Problem& problem, Vector& solution) {
    const Precision precision = system_.precision();
    const Vector guess = solution;
    const auto start_again = [&] {
        solution = guess;
        solution.update_ghost_values();
    };
    changes_.clear();
    const Ending with_old = iterate_with_old_factors(problem, solution);
    if (with_old == Ending::converged) return;
    if (with_old == Ending::diverged) start_again();
    if (distrust_of_single_.may_try()) system_.use(Precision::single);
    const bool single = system_.precision() == Precision::single;
    for (int k = 0; k < most_factorisations; ++k) {
        const Ending ending = iterate_with_new_factors(problem, solution);
        if (ending == Ending::converged) {
            if (single) distrust_of_single_.note(system_.precision() != Precision::single);
            return;
        }
        if (ending == Ending::slow && k == 0) continue;  // one step of Newton's method from the guess was not enough
        if (system_.precision() == Precision::single) {
            start_again();
            ++counts_.single_precision_failed;
            system_.use(Precision::full);
        } else if (ending == Ending::diverged) {
            break;
        }
    }
    system_.forget_factors();
    system_.use(precision);
    throw SolverError("newton-divergence", "Newton's method changed ψ by" + changes_ + " nm",
                      "use a smaller time.tolerance or phase_field.cell_size");
}

std::vector<const Vector*> StepSolver::save(Checkpoint& checkpoint) const {
    const bool there = system_.has_factors();
    checkpoint.scalars["factors_full_precision"] = system_.precision() == Precision::full ? 1 : 0;
    checkpoint.arrays["solver_counts"] = {
        static_cast<double>(counts_.iterations), static_cast<double>(counts_.factorisations),
        static_cast<double>(counts_.of_double_precision), static_cast<double>(counts_.single_precision_failed)};
    checkpoint.arrays["factors_distrust"] = distrust_of_old_.numbers();
    checkpoint.arrays["single_precision_distrust"] = distrust_of_single_.numbers();
    checkpoint.scalars["factors_rate"] = origin_.rate;
    checkpoint.scalars["factors_speed"] = origin_.speed;
    checkpoint.scalars["factors_molecules"] = origin_.molecules;
    save_thickness(origin_.thickness, "factors_thickness", checkpoint);
    if (origin_.pole_force) origin_.pole_force->save("factors_pole_force", checkpoint);
    checkpoint.arrays["factors_weights"] = there ? origin_.weights : std::vector<double>{};
    checkpoint.arrays["factors_ahead"] = there ? origin_.ahead : std::vector<double>{};
    std::vector<const Vector*> out;
    if (there)
        for (const auto& vector : origin_.vectors) out.push_back(&vector);
    return out;
}

std::size_t StepSolver::saved_vectors(const Checkpoint& checkpoint) {
    const std::size_t count = checkpoint.array("factors_weights").size();
    return count == 0 ? 0 : count + vectors_of_guess;
}

void StepSolver::load(const Space& space, StepNumbers numbers, const Checkpoint& checkpoint,
                      const std::vector<Vector>& vectors) {
    if (checkpoint.scalar("factors_full_precision") != 0) system_.use(Precision::full);
    const auto& counts = checkpoint.array("solver_counts");
    const auto whole = [](double number) { return static_cast<unsigned int>(number); };
    if (!vectors.empty()) factorise_again(space, std::move(numbers), checkpoint, vectors);
    // Without the factors just made.
    counts_ = {whole(counts.at(0)), whole(counts.at(1)), whole(counts.at(2)), whole(counts.at(3))};
    distrust_of_old_ = Distrust::from(checkpoint.array("factors_distrust"));
    distrust_of_single_ = Distrust::from(checkpoint.array("single_precision_distrust"));
}

void StepSolver::factorise_again(const Space& space, StepNumbers numbers, const Checkpoint& checkpoint,
                                 const std::vector<Vector>& vectors) {
    numbers.rate = checkpoint.scalar("factors_rate");
    numbers.move_at(checkpoint.scalar("factors_speed"));
    numbers.thickness = thickness_on(space.dofs.get_triangulation(), load_thickness(checkpoint, "factors_thickness"));
    numbers.molecules = checkpoint.scalar("factors_molecules");
    numbers.pole_force = PoleForce::load(checkpoint, "factors_pole_force", numbers.loads);
    const std::vector<Vector> solutions(vectors.begin() + vectors_of_guess, vectors.end());
    const StepPast history(space, numbers, solutions, checkpoint.array("factors_weights"),
                           checkpoint.array("factors_ahead"), vectors[1]);
    factorise({&space, &numbers, &history}, vectors[0]);
}

}  // namespace endoflow::phasefield::production
