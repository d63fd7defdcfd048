#pragma once

#include <string>
#include <vector>

#include "phasefield/schemes/production/step_factors.h"

namespace endoflow::phasefield::production {

/// How often in a row something has failed, and for how many steps it is left alone for it: 2^(k − 2) after k failures.
class Backoff {
  public:
    /// Whether this step may try it: asked once per step.
    [[nodiscard]] bool may_try();
    void note(bool failed);

  private:
    unsigned int failures_ = 0, steps_ = 0;
};

/// Newton's method for the coupled equations of a step: first, with Anderson's acceleration, by the factors that there
/// are; then by new ones of single precision, at most of double precision.
class StepSolver {
  public:
    StepSolver(const Parameters& parameters, MPI_Comm communicator);

    /// The mesh has changed: nothing is left of the factors.
    void reinit(const Space& space, const MembraneCurve& membrane) { factors_.reinit(space, membrane); }

    /// `solution` holds the guess, then the solution, both with ghost values. `wanted`: the change of ψ in the layer
    /// [nm] to which the method converges. Throws SolverError("newton-divergence", …); the next call starts with new
    /// factors. Throws Interrupted between two iterations.
    void solve(const StepProblem& problem, Vector& solution, double wanted);

    [[nodiscard]] const StepFactors& factors() const { return factors_; }
    [[nodiscard]] unsigned int iterations() const { return iterations_; }
    /// How often single precision gave way to double.
    [[nodiscard]] unsigned int single_precision_failed() const { return single_precision_failed_; }

    /// What has been done so far. A run that is continued begins with new factors.
    template <class Archive>
    void serialize(Archive& archive) {
        archive("iterations", iterations_);
        archive("single_precision_failed", single_precision_failed_);
        factors_.serialize(archive);
    }

  private:
    enum class Ending { converged, slow, diverged };

    /// Diverged, too, when they came no closer, or what they lead to is no number: new ones may serve from the guess.
    Ending iterate_with_old_factors(const StepProblem& problem, Vector& solution);
    /// Diverged, too, when there are no factors of single precision.
    Ending iterate_with_new_factors(const StepProblem& problem, Vector& solution);
    /// Iterations with the present factors; `newton`: the first increment, if they were made at `solution`.
    Ending iterate(const StepProblem& problem, Vector& solution, const Vector* newton);

    StepFactors factors_;
    Backoff old_factors_, single_precision_;
    unsigned int iterations_ = 0, single_precision_failed_ = 0;
    double wanted_ = 0;
    std::vector<double> least_;  // first increments that count, field by field
    std::string changes_;        // of ψ, for the error message
};

}  // namespace endoflow::phasefield::production
