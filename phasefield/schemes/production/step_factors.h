#pragma once

#include "phasefield/contour/parts_along.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/solver/block_gauss_seidel.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield::production {

/// Factors of the equations' Jacobian, in two blocks where some fields are carried along by the others. Making
/// them costs as much as twenty solutions with them, so those of an earlier step are kept.
class StepFactors {
  public:
    StepFactors(const Parameters& parameters, MPI_Comm communicator);

    /// The mesh has changed: there are none. Processes share the elimination along the membrane, so each has two
    /// neighbours, and few unknowns in common with them; as much of it as parts of the last mesh let expect.
    void reinit(const Space& space, const MembraneCurve& membrane);
    void forget() { system_.forget_factors(); }

    /// In single precision, or not; forgets those there are where that changes.
    void use(Precision precision) { system_.use(precision); }
    [[nodiscard]] Precision precision() const { return system_.precision(); }

    /// Whether there are some that were made near this solution.
    [[nodiscard]] bool serve(const StepProblem& problem, const Vector& solution) const;
    /// New ones at `solution`, and Newton's increment there. Throws SolverError where the Jacobian is singular.
    Vector make(const StepProblem& problem, const Vector& solution);
    /// −(factors)⁻¹ × the residual at `solution`.
    [[nodiscard]] Vector increment(const StepProblem& problem, const Vector& solution);

    [[nodiscard]] unsigned int made() const { return made_; }
    [[nodiscard]] unsigned int made_in_full_precision() const { return full_; }
    /// What the processes solve for together on the present mesh.
    [[nodiscard]] CondensedSystem::Index shared_unknowns() const { return system_.shared_unknowns(); }

    template <class Archive>
    void serialize(Archive& archive) {
        archive("factorisations", made_);
        archive("factorisations_of_double_precision", full_);
    }

  private:
    std::vector<PatternEntry> pattern_ = equation_pattern();
    BlockGaussSeidel system_;
    std::vector<PartAlong> parts_;  // of the present mesh
    Vector origin_;                 // where they were made
    unsigned int made_ = 0, full_ = 0;
};

}  // namespace endoflow::phasefield::production
