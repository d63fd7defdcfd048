#pragma once

// Perturbations y = (w, c') as vectors: how large they are, how they move with the mesh of a run, and those that a run
// may start with.

#include <string>
#include <vector>

#include "boundary_integral/modes/linear_propagation.h"
#include "boundary_integral/modes/linearised_membrane.h"

namespace endoflow::boundary_integral {

/// Cholesky factors R of the mass matrices: int w^2 dA = pi |R w|^2, likewise c'.
struct PerturbationNorms {
    Eigen::MatrixXd displacement, concentration;
};
[[nodiscard]] PerturbationNorms perturbation_norms(const ModeSpace& space, const BasePoints& points);

/// Of the membrane, nm^2.
[[nodiscard]] double area_of(const MembraneSpace& space, const BasePoints& base);

/// dy/dt for the coefficients of the run's own moving mesh; `relative_velocity` as in Evaluation. Errors are measured
/// in w, and in c' times `concentration_length` (nm).
[[nodiscard]] LinearRate mesh_rate(const LinearisedMembrane& membrane, const ModeSpace& space, const ModeRates& rates,
                                   const std::vector<double>& relative_velocity, double concentration_length);

/// Points of the meridian, eight per element, where shapes are written.
[[nodiscard]] std::vector<double> meridian_points(const MembraneSpace& space);

/// Values of w or c' at points of the meridian from the coefficients in y.
[[nodiscard]] Eigen::MatrixXd displacement_values(const ModeSpace& space, const std::vector<double>& xi);
[[nodiscard]] Eigen::MatrixXd concentration_values(const ModeSpace& space, const std::vector<double>& xi);

struct InitialShape {
    std::string name;
    Eigen::VectorXd y;
};

/// Shapes that the membrane at its start may deviate by, of `amplitude` (nm), the largest of |w|:
///   dome    w ~ s^m exp(-m s^2 / 2 s_0^2), largest half-way from the axis to the coat's edge (s: arc length)
///   edge    the same, largest at the coat's edge
///   sheet   one hump from the axis to the rim (to the other pole)
///   coat    no displacement: the coat's edge lies `amplitude` cos(m phi) farther out, c' = - amplitude C_s
[[nodiscard]] std::vector<InitialShape> initial_shapes(const ModeSpace& space, const MembraneState& state,
                                                       double coat_radius, double amplitude);

}  // namespace endoflow::boundary_integral
