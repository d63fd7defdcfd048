#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>

#include "phasefield/discretization/local_system.h"
#include "phasefield/production/point_equations.h"
#include "phasefield/solver/linear_system.h"

namespace endoflow::phasefield::production {

/// Value, ∂r and ∂z of all fields at a point.
using PointValues = std::array<std::array<double, 3>, n_fields>;

/// The past of a step: solutions newest first with their BDF weights, and the straight line through the last two, which
/// gives the normals.
struct StepHistory {
    const std::vector<Vector>* solutions;
    std::vector<double> weights;  // [1/µs]
    const Vector* extrapolated;
    /// Method of manufactured solutions: the fields at (r, z) whose residual is taken off, so that they are the
    /// solution.
    std::function<PointValues(double, double)> manufactured = {};
};

/// Which rows contain which fields, found by differentiating the equations once.
class EquationPattern {
  public:
    EquationPattern(const Parameters& parameters, const BendingModel& model);
    struct Entry {
        unsigned int row, column;  // 3 × field + {value, ∂r, ∂z}
    };
    std::vector<Entry> entries;
    Couplings couplings;
};

/// Jacobian and −residual of the coupled equations at `iterate` into `system`.
void assemble(const Space& space, const EquationPattern& pattern, const BendingModel& model, const StepNumbers& step,
              const StepHistory& history, const Vector& iterate, LinearSystem& system);

/// −residual alone; the Jacobian stays what it was.
void assemble_residual(const Space& space, const EquationPattern& pattern, const BendingModel& model,
                       const StepNumbers& step, const StepHistory& history, const Vector& iterate,
                       LinearSystem& system);

/// The membrane's net vertical force on the fluid [pN]: it balances what the pinned rim exerts. Collective.
double net_vertical_force(const Space& space, const BendingModel& model, const StepNumbers& step,
                          const StepHistory& history, const Vector& solution);

/// Gauss points per direction.
unsigned int gauss_points(const PhaseFieldParameters& parameters);

}  // namespace endoflow::phasefield::production
