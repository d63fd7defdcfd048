#pragma once

#include <memory>

#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/production/step_solver.h"

namespace endoflow::phasefield::production {

/// Numbers of a step; rate a₀ and profile relaxation M as given [1/µs, nm/µs].
inline StepNumbers step_numbers(const Parameters& p, double rate, double profile_relaxation) {
    const auto weight = membrane_weight(p.fluid, p.phase_field.viscosity_mean);
    return {rate, p.phase_field, p.fluid, p.molecules, weight, scheme_rates(p), profile_relaxation};
}

/// The unknowns of a case on its coarse mesh and what solves for one step, on one process.
struct OneStep {
    OneStep(const Parameters& p, double tolerance)
        : mesh(coarse_mesh(p, MPI_COMM_SELF)),
          space(*mesh, field_degrees(p.phase_field)),
          model(p.membrane),
          solver(p, model, MPI_COMM_SELF, tolerance) {
        space.distribute();
        close_constraints(space, p);
        solver.reinit(space);
    }

    std::unique_ptr<Mesh> mesh;
    Space space;
    BendingModel model;
    StepSolver solver;
};

}  // namespace endoflow::phasefield::production
