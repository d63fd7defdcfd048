#pragma once

// Stokes flow in the box that a membrane of given shape, concentration and law drives, with walls, pin band, viscosity
// contrast, inextensibility and inflow through the rim.

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/operators/membrane_layers.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

// Velocities of the clamped membrane with inflow, W = { w : w_z(rim) = 0, slope of the moving curve stays 0 }. The mesh
// velocity is w - a t phi with a = w_r(rim), phi(rim) = 1, so the slope condition reads w_z'(rim) = (z''/g)(rim)
// w_r(rim). Freedoms: all radial coefficients, all axial ones but the last two. Matrices act on full coefficient
// vectors (curve_count).
struct ClampedVelocities {
    Index radial_count = 0;
    Index axial_count = 0;
    double slope_factor = 0.0;  // last-but-one axial coefficient per last radial one

    ClampedVelocities() = default;
    ClampedVelocities(const MembraneSpace& space, const MembraneState& state);
    Index freedoms() const { return radial_count + axial_count - 2; }
    Eigen::VectorXd expand(const Eigen::VectorXd& freedoms) const;
    Eigen::MatrixXd restrict_columns(const Eigen::MatrixXd& matrix) const;  // M P
    Eigen::MatrixXd restrict_rows(const Eigen::MatrixXd& matrix) const;     // P^T M
};

// The hydrodynamic operators of one shape. Everything here depends on the curve alone.
struct MobilityOperators {
    ClampedVelocities clamped;
    Eigen::MatrixXd force_from_load;  // N^-1: force density coefficients from a load (freedoms of W)
    Eigen::MatrixXd
        mobility;  // velocity freedoms from a load (freedoms of W); positive definite up to the quadrature error
    RowMatrix wall_from_force;     // wall right-hand side per force coefficient
    RowMatrix wall_from_velocity;  // wall right-hand side per velocity coefficient (full)
};

struct FlowSolution {
    Eigen::VectorXd velocity;  // curve_count coefficients (u_r, u_z), nm/us
    Eigen::VectorXd force;     // force_count coefficients of f, pN/nm^2
    Eigen::VectorXd tension;   // coefficients of lambda, pN/nm
    Eigen::VectorXd load;      // freedoms of W: -(dE - inflow) - C^T lambda, pN per 2 pi
    double inflow = 0.0;       // u_r(rim), nm/us
};

class BoxFlow {
  public:
    BoxFlow(const Parameters& parameters, const MembraneSpace& space);

    const WallPanels& walls() const { return walls_; }

    MobilityOperators operators(const MembraneState& state, const MembraneSamples& samples) const;

    // Velocity, force density and tension under the membrane's own elastic force.
    FlowSolution solve(const MobilityOperators& operators, const MembraneSamples& samples,
                       const EnergyDerivatives& energy, double rim_energy_density) const;

    // Wall unknowns (see WallPanels) that go with a solution.
    Eigen::VectorXd wall_unknowns(const MobilityOperators& operators, const FlowSolution& flow) const;

    bool inextensible() const { return inextensible_; }
    int threads() const { return threads_; }

  private:
    const MembraneSpace& space_;
    WallPanels walls_;
    double viscosity_below_, viscosity_above_;
    bool inextensible_;
    int threads_;
    std::vector<WallTarget> wall_targets_;
    std::vector<MembraneTarget> wall_as_membrane_targets_;
    std::optional<LuFactors> wall_factors_;
};

// Independent balances of a solution, all relative and zero for the exact solution.
struct FlowBalances {
    double force;               // total axial force of membrane and band over the sum of their moduli
    double net_flux;            // volume flux out of both phases over the modulus of the flux through the membrane
    double area;                // int div_Gamma u dA over the inflow R a
    double power_pN_nm_per_us;  // work of the membrane on the fluid per time = dissipation
};
FlowBalances flow_balances(const MembraneSpace& space, const BoxFlow& box, const MembraneSamples& samples,
                           const FlowSolution& flow, const Eigen::VectorXd& wall_unknowns);

}  // namespace endoflow::boundary_integral
