#include "phasefield/schemes/production/step_factors.h"

#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/diagnostics.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double farthest = constant("farthest");

/// What is carried along comes last, so that its balance holds after a sweep.
std::vector<std::vector<unsigned int>> blocks_of_fields(const Parameters& parameters) {
    std::vector<std::vector<unsigned int>> out(2);
    for (unsigned int field = 0; field < n_fields; ++field)
        out[carried_along(field, parameters) ? 1 : 0].push_back(field);
    if (out.back().empty()) out.pop_back();
    return out;
}

}  // namespace

StepFactors::StepFactors(const Parameters& parameters, MPI_Comm communicator)
    : system_(communicator, "coupled", blocks_of_fields(parameters)) {}

void StepFactors::reinit(const Space& space, const MembraneCurve& membrane) {
    const auto parts = parts_along(membrane, space, parts_);
    system_.reinit(space, parts);
    parts_ = measured_parts(parts, system_.operations(), space);
}

bool StepFactors::serve(const StepProblem& problem, const Vector& solution) const {
    if (!system_.has_factors()) return false;
    Vector moved = solution;
    moved -= origin_;
    moved.update_ghost_values();
    return layer_increment(problem.space, problem.numbers, moved, solution) <
           farthest * problem.numbers.numerics.epsilon;
}

Vector StepFactors::make(const StepProblem& problem, const Vector& solution) {
    origin_.reinit(solution, true);  // assignment alone could keep the ghosts of an earlier mesh
    origin_ = solution;
    assemble(problem, pattern_, solution, system_);
    Vector out = problem.space.vector();
    ++made_;
    if (system_.precision() == Precision::full) ++full_;
    system_.forget_factors();
    system_.solve(problem.space, out);
    return out;
}

Vector StepFactors::increment(const StepProblem& problem, const Vector& solution) {
    assemble_residual(problem, solution, system_);
    Vector out = problem.space.vector();
    system_.apply_factors(problem.space, out);
    return out;
}

}  // namespace endoflow::phasefield::production
