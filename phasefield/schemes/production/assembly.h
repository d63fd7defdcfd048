#pragma once

#include <vector>

#include "phasefield/fem/local_system.h"
#include "phasefield/schemes/production/past.h"
#include "phasefield/solver/condensed_system.h"

namespace endoflow::phasefield::production {

/// Which rows contain which fields, found by differentiating the equations once.
class EquationPattern {
  public:
    EquationPattern(const Parameters& parameters, const LayerEnergy& energy);
    struct Entry {
        unsigned int row, column;  // 3 × field + {value, ∂r, ∂z}
    };
    std::vector<Entry> entries;
};

/// Jacobian and −residual of the coupled equations at `iterate` into `system`.
void assemble(const Space& space, const EquationPattern& pattern, const LayerEnergy& energy, const StepNumbers& step,
              const StepPast& history, const Vector& iterate, CondensedSystem& system);

/// −residual alone; the Jacobian stays what it was.
void assemble_residual(const Space& space, const EquationPattern& pattern, const LayerEnergy& energy,
                       const StepNumbers& step, const StepPast& history, const Vector& iterate,
                       CondensedSystem& system);

/// The membrane's net vertical force on the fluid [pN]: it balances what the pinned rim exerts. Collective.
double net_vertical_force(const Space& space, const LayerEnergy& energy, const StepNumbers& step,
                          const StepPast& history, const Vector& solution);

/// Gauss points per direction.
unsigned int gauss_points(const PhaseFieldParameters& parameters);

}  // namespace endoflow::phasefield::production
