#pragma once

#include <deal.II/base/quadrature.h>

#include "phasefield/fem/component_field.h"
#include "phasefield/schemes/production/cell_points.h"
#include "phasefield/schemes/production/past.h"

namespace endoflow::phasefield::production {

/// The rim tension σ: ∮ δ_Γ σ v_r dA where the membrane leaves the box at r = R, flat. Without it λ = 0 there is
/// natural, with it λ = σ.
class RimTension {
  public:
    RimTension(const Space& space, const StepNumbers& step);

    /// Adds the force on the test functions of a cell to its right-hand side, over 2π.
    void add(const Cell& cell, const Vector& solution, dealii::Vector<double>& right_hand_side);

    /// Its power through a cell's face [pN nm/µs].
    double power(const Cell& cell, const Vector& solution);

  private:
    /// Calls visit(q, force) at the points of the cell's face on the side, force over 2π.
    template <class Visit>
    void on_side(const Cell& cell, const Vector& solution, const Visit& visit);

    const Space* space_;
    const StepNumbers* step_;
    dealii::Quadrature<2> quadrature_;
    ScalarBasis shapes_;  // of u_r
    ComponentField psi_, u_r_;
};

/// Power of all loads at the end of a step [pN nm/µs]; collective.
double load_power(const StepProblem& problem, const Vector& solution);

}  // namespace endoflow::phasefield::production
