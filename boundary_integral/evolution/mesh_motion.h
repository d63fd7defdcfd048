#pragma once

// Where the elements go: the mesh follows the material, except for the inflow at the rim and a slow relaxation towards
// the element density that the coat edge and the curvature ask for.

#include <Eigen/Core>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/membrane/membrane_space.h"

namespace endoflow::boundary_integral {

// Elements per arc length are proportional to
//     rho = sqrt(1 + (curvature_length)^2 (kappa_m^2 + kappa_p^2) + (edge_weight 4 c (1 - c))^2)
struct MeshDensity {
    double curvature_length;  // nm
    double edge_weight;
    double relaxation_time;  // us
    double smoothing;        // rho is filtered over this length in xi, whatever the number of elements
};

class MeshMotion {
  public:
    MeshMotion(const MembraneSpace& space, const MeshDensity& density);

    // Rate of the relaxation [1/us] for a membrane with this velocity (curve_count): 1/tau in motion, a tenth of it at
    // rest. The mesh has to follow a membrane that moves, and must not be stiff on one that hardly does.
    double relaxation_rate(const Eigen::VectorXd& velocity) const;

    // Tangential velocity field added to the material velocity, as coefficients (curve_count), nm/us:
    //     alpha t,  alpha = -inflow xi^5 - rate (N - xi) g / N'
    // N(xi): fraction of elements the density wants between the axis and xi.
    Eigen::VectorXd tangential_velocity(const MembraneState& state, const MembraneSamples& samples, double inflow,
                                        double rate) const;

    // Its derivative with respect to the inflow, and with respect to the curve at fixed density rho (relaxation only).
    Eigen::VectorXd derivative_by_inflow(const MembraneState& state) const;
    Eigen::MatrixXd derivative_by_curve(const MembraneState& state, const MembraneSamples& samples,
                                        double inflow) const;

    // The wanted element numbers N as radial coefficients; N(1) = 1.
    Eigen::VectorXd wanted_numbers(const MembraneSamples& samples) const;

  private:
    const MembraneSpace& space_;
    MeshDensity density_;
    std::vector<double> radial_points_, axial_points_;  // Greville points of the two spaces
    LuFactors radial_interpolation_, axial_interpolation_, filter_, antiderivative_;

    double relaxation_rate(double inflow) const;                                 // 1/us
    std::vector<double> filtered_density(const MembraneSamples& samples) const;  // at the Gauss points
    template <class Speed>
    Eigen::VectorXd interpolate_tangential(const MembraneState& state, Speed speed) const;
};

// Interpolates values at the Greville points of a space.
Eigen::VectorXd interpolate(const SplineSpace& space, const std::vector<double>& values_at_greville_points);

}  // namespace endoflow::boundary_integral
