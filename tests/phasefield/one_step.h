#pragma once

#include <memory>

#include "phasefield/fem/mesh.h"
#include "phasefield/layer/initial_membrane.h"
#include "phasefield/schemes/production/step_solver.h"

namespace endoflow::phasefield::production {

/// Numbers of a step; rate a₀ and profile relaxation M as given [1/µs, nm/µs].
inline StepNumbers step_numbers(const Parameters& p, double rate, double profile_relaxation) {
    StepNumbers numbers(CaseNumbers(p), rate);
    numbers.profile_relaxation = profile_relaxation;
    return numbers;
}

/// The unknowns of a case on its coarse mesh and what solves for one step, on one process.
struct OneStep {
    explicit OneStep(const Parameters& p)
        : mesh(coarse_mesh(p, MPI_COMM_SELF)),
          space(*mesh, field_degrees(p.phase_field)),
          energy(p),
          solver(p, MPI_COMM_SELF) {
        space.distribute();
        close_constraints(space, p);
        solver.reinit(space, InitialMembrane(p).curve(1.0));
    }

    std::unique_ptr<Mesh> mesh;
    Space space;
    LayerEnergy energy;
    StepSolver solver;
};

}  // namespace endoflow::phasefield::production
