#pragma once

#include <array>
#include <functional>
#include <vector>

#include "phasefield/fem/space.h"
#include "phasefield/schemes/production/point_equations.h"

namespace endoflow::phasefield::production {

/// Value, ∂r and ∂z of all fields at a point.
using PointValues = std::array<std::array<double, 3>, n_fields>;

/// The past of a step: solutions newest first with their weights in BDF and in the polynomial through them at the
/// step's end, the straight line through the last two, which gives the normals, and what the equations need of them.
/// The vectors must have ghost values and outlive the history.
struct StepPast {
    StepPast(const Space& space, const StepNumbers& step, const std::vector<Vector>& solutions,
             std::vector<double> weights, std::vector<double> ahead, const Vector& extrapolated);

    const std::vector<Vector>* solutions;
    std::vector<double> weights;  // [1/µs]
    std::vector<double> ahead;    // sum up to one
    const Vector* extrapolated;
    std::vector<std::vector<PointPast>> points;  // [active cell of this process][quadrature point]
    /// Method of manufactured solutions: the fields at (r, z) whose residual is taken off, so that they are the
    /// solution.
    std::function<PointValues(double, double)> manufactured;
};

/// The equations of one step.
struct StepProblem {
    const Space& space;
    const LayerEnergy& energy;
    const StepNumbers& numbers;
    const StepPast& past;
};

}  // namespace endoflow::phasefield::production
