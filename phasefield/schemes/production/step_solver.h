#pragma once

#include <string>
#include <vector>

#include "phasefield/schemes/production/assembly.h"
#include "phasefield/solver/condensed_system.h"
#include "shared/output/checkpoint.h"

namespace endoflow::phasefield::production {

/// Newton's method for the coupled equations of a step. A factorisation costs as much as twenty-five to thirty
/// iterations with old factors, so those of an earlier step are used, with Anderson's acceleration, for as long as they
/// serve.
class StepSolver {
  public:
    /// `wanted`: the change of ψ in the layer [nm] to which the method converges.
    StepSolver(const Parameters& parameters, const LayerEnergy& energy, MPI_Comm communicator, double wanted);

    /// The mesh has changed: nothing is left of the factors.
    void reinit(const Space& space);

    /// `solution` holds the guess, then the solution, both with ghost values.
    /// Throws SolverError("newton-divergence", …); the next call starts with new factors. Throws Interrupted between
    /// two iterations; save() then tells of the factors that there were before.
    void solve(const Space& space, const StepNumbers& numbers, const StepPast& history, Vector& solution);

    /// What the factors were made from, so that a restart goes on with the same ones: vectors on the present mesh, and
    /// numbers. The vectors are addresses of the solver's own.
    [[nodiscard]] std::vector<const Vector*> save(Checkpoint& checkpoint) const;
    /// The bulk that the factors have seen, if there are any.
    [[nodiscard]] std::shared_ptr<const BulkSupply> supply_of_factors() const {
        return system_.has_factors() ? origin_.supply : nullptr;
    }
    /// How many vectors were saved.
    [[nodiscard]] static std::size_t saved_vectors(const Checkpoint& checkpoint);
    /// Makes the factors again; `numbers` as of any step, but with supply_of_factors(), `vectors` with ghost values.
    void load(const Space& space, StepNumbers numbers, const Checkpoint& checkpoint,
              const std::vector<Vector>& vectors);

    /// What has been done so far, in a run that was continued from its start.
    struct Counts {
        unsigned int iterations = 0, factorisations = 0, of_double_precision = 0;
        unsigned int single_precision_failed = 0;  // and gave way to double precision
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }
    /// What the processes solve for together on the present mesh.
    [[nodiscard]] SubdomainSystem::Index shared_unknowns() const { return system_.shared_unknowns(); }

  private:
    enum class Ending { converged, slow, diverged };

    /// The equations of one step.
    struct Problem {
        const Space* space;
        const StepNumbers* numbers;
        const StepPast* history;
    };

    /// What the factors were made from.
    struct Origin {
        double rate = 0, speed = 0, molecules = 0;
        std::shared_ptr<const CellThickness> thickness;
        std::shared_ptr<const PoleForce> pole_force;
        std::shared_ptr<const BulkSupply> supply;
        std::vector<double> weights, ahead;
        std::vector<Vector> vectors;  // the iterate, the guess, the solutions before, newest first
    };

    /// How often in a row something has failed, and how many steps long it is left alone for it.
    class Distrust {
      public:
        /// Whether the next step may try it: asked once per step.
        [[nodiscard]] bool may_try();
        void note(bool failed);
        [[nodiscard]] std::vector<double> numbers() const;
        static Distrust from(const std::vector<double>& numbers);

      private:
        unsigned int failures_ = 0, steps_ = 0;
    };

    void converge(const Problem& problem, Vector& solution);
    [[nodiscard]] bool near_factors(const Problem& problem, const Vector& solution) const;
    /// Those of a checkpoint.
    void factorise_again(const Space& space, StepNumbers numbers, const Checkpoint& checkpoint,
                         const std::vector<Vector>& vectors);
    /// New factors at `solution`, and Newton's increment there.
    Vector factorise(const Problem& problem, const Vector& solution);
    [[nodiscard]] Vector increment(const Problem& problem, const Vector& solution);
    /// Diverged, too, when what they lead to is no number: new ones may serve.
    Ending iterate_with_old_factors(const Problem& problem, Vector& solution);
    /// Iterations with the present factors; `newton`: the first increment, if they were made at `solution`.
    Ending iterate(const Problem& problem, Vector& solution, const Vector* newton);
    /// Diverged, too, when there are no factors of single precision.
    Ending iterate_with_new_factors(const Problem& problem, Vector& solution);

    LayerEnergy energy_;
    EquationPattern pattern_;
    CondensedSystem system_;
    Origin origin_;
    Distrust distrust_of_old_, distrust_of_single_;
    Counts counts_;
    double wanted_;
    std::vector<double> least_;  // first increments that count, field by field
    std::string changes_;        // of ψ, for the error message
};

}  // namespace endoflow::phasefield::production
