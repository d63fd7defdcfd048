#pragma once

#include <vector>

#include "phasefield/fem/local_system.h"
#include "phasefield/schemes/production/equation_pattern.h"
#include "phasefield/schemes/production/past.h"
#include "phasefield/solver/block_gauss_seidel.h"

namespace endoflow::phasefield::production {

/// Jacobian and −residual of a step's equations at `iterate` into `system`.
void assemble(const StepProblem& problem, const std::vector<PatternEntry>& pattern, const Vector& iterate,
              BlockGaussSeidel& system);

/// −residual alone; the Jacobian stays what it was.
void assemble_residual(const StepProblem& problem, const Vector& iterate, BlockGaussSeidel& system);

/// The membrane's net vertical force on the fluid [pN]: it balances what the pinned rim exerts. Collective.
double net_vertical_force(const StepProblem& problem, const Vector& solution);

/// Gauss points per direction.
unsigned int gauss_points(const PhaseFieldParameters& parameters);

}  // namespace endoflow::phasefield::production
