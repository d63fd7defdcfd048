#include "phasefield/schemes/production/step_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "phasefield/fem/interruption.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/diagnostics.h"
#include "phasefield/solver/anderson.h"
#include "shared/support/error.h"

namespace endoflow::phasefield::production {

namespace {

constexpr int most_iterations = count("most_iterations");
constexpr int seen_enough = count("seen_enough");
constexpr unsigned int most_failures = count("most_failures");
constexpr int most_factorisations = count("most_factorisations");
constexpr double fast_contraction = constant("fast_contraction");
constexpr double largest_rest = constant("largest_rest");
constexpr double round_off = constant("round_off");
constexpr double most_divergence = constant("most_divergence");

}  // namespace

bool Backoff::may_try() {
    if (steps_ == 0) return true;
    --steps_;
    return false;
}

void Backoff::note(bool failed) {
    failures_ = failed ? std::min(failures_ + 1, most_failures) : 0;
    steps_ = failures_ < 2 ? 0 : 1U << (failures_ - 2);
}

StepSolver::StepSolver(const Parameters& parameters, MPI_Comm communicator) : factors_(parameters, communicator) {
    const Scales by = scales(parameters);
    for (const auto& unknown : unknowns()) least_.push_back(round_off * unknown.size(by));
}

StepSolver::Ending StepSolver::iterate(const StepProblem& problem, Vector& solution, const Vector* newton) {
    std::optional<AndersonMixing> mixing;
    // The first two changes: a sweep over blocks from new factors can change more than Newton's increment did.
    double first = wanted_, last = 0;
    const int most = newton == nullptr ? most_iterations : 2 * most_iterations;  // there are no better factors
    for (int iteration = 0; iteration < most; ++iteration) {
        give_up_if_interrupted(problem.space.dofs.get_communicator());
        ++iterations_;
        const bool at_factors = iteration == 0 && newton != nullptr;
        const Vector step = at_factors ? *newton : factors_.increment(problem, solution);
        const double change = layer_increment(problem.space, problem.numbers, step, solution);
        char text[24];
        std::snprintf(text, sizeof text, at_factors ? " %.1e" : " (%.1e)", change);
        changes_ += text;
        if (iteration < 2) first = std::max(first, change);
        if (!std::isfinite(change) || change > most_divergence * first) return Ending::diverged;
        if (!mixing) mixing.emplace(problem.space, least_, presence(problem.space, problem.numbers, solution));
        mixing->advance(solution, step);
        const double contraction = change / std::exchange(last, change);
        const bool foreseen = newton != nullptr && iteration > 0 && contraction < fast_contraction;
        const bool arrived = change <= wanted_ || (foreseen && change * contraction <= 0.5 * wanted_);
        if (arrived && mixing->norm(step) <= largest_rest) return Ending::converged;
        if (iteration >= seen_enough && std::log(wanted_ / first) < most * std::log(change / first) / iteration)
            break;  // it would take more at this rate
    }
    return newton == nullptr && last > first / most_divergence ? Ending::diverged : Ending::slow;
}

StepSolver::Ending StepSolver::iterate_with_old_factors(const StepProblem& problem, Vector& solution) {
    if (!factors_.serve(problem, solution) || !old_factors_.may_try()) return Ending::slow;
    Ending ending = Ending::diverged;
    try {
        ending = iterate(problem, solution, nullptr);
    } catch (const SolverError&) {  // new factors may serve
    }
    old_factors_.note(ending != Ending::converged);
    return ending;
}

StepSolver::Ending StepSolver::iterate_with_new_factors(const StepProblem& problem, Vector& solution) {
    give_up_if_interrupted(problem.space.dofs.get_communicator());
    try {
        const Vector newton = factors_.make(problem, solution);
        return iterate(problem, solution, &newton);
    } catch (const SolverError&) {
        if (factors_.precision() == Precision::full) throw;
        return Ending::diverged;
    }
}

void StepSolver::solve(const StepProblem& problem, Vector& solution, double wanted) {
    wanted_ = wanted;
    const Precision precision = factors_.precision();
    const Vector guess = solution;
    const auto start_again = [&] {
        solution = guess;
        solution.update_ghost_values();
    };
    changes_.clear();
    const Ending with_old = iterate_with_old_factors(problem, solution);
    if (with_old == Ending::converged) return;
    if (with_old == Ending::diverged) start_again();
    if (single_precision_.may_try()) factors_.use(Precision::single);
    const bool single = factors_.precision() == Precision::single;
    for (int k = 0; k < most_factorisations; ++k) {
        const Ending ending = iterate_with_new_factors(problem, solution);
        if (ending == Ending::converged) {
            if (single) single_precision_.note(factors_.precision() != Precision::single);
            return;
        }
        if (ending == Ending::slow && k == 0) continue;  // one step of Newton's method from the guess was not enough
        if (factors_.precision() == Precision::single) {
            start_again();
            ++single_precision_failed_;
            factors_.use(Precision::full);
        } else if (ending == Ending::diverged) {
            break;
        }
    }
    factors_.forget();
    factors_.use(precision);
    throw SolverError("newton-divergence", "Newton's method changed ψ by" + changes_ + " nm",
                      "use a smaller time.tolerance or phase_field.cell_size");
}

}  // namespace endoflow::phasefield::production
