#pragma once

// From the membrane's elastic force to its velocity. How the surroundings answer a force is the models' part: fluids in
// a box, fluids without end, or no fluid at all.

#include <Eigen/Core>
#include <vector>

#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/operators/layer_target.h"
#include "shared/model/rest.h"

namespace endoflow::boundary_integral {

/// The velocities a model admits. Matrices act on full coefficient vectors (curve_count); the freedoms are all radial
/// coefficients but the last `fixed_radial`, then all axial ones but the last `fixed_axial`.
struct VelocityFreedoms {
    Index radial_count = 0, axial_count = 0;
    Index fixed_radial = 0, fixed_axial = 0;
    bool inflow = false;        // the last radial freedom is the velocity through the rim
    double slope_factor = 0.0;  // last-but-one axial coefficient per velocity through the rim

    /// W = { w : w_z(rim) = 0, slope of the moving curve stays 0 }. The mesh velocity is w - a t φ with a = w_r(rim),
    /// φ(rim) = 1, so the slope condition reads w_z'(rim) = (z''/g)(rim) w_r(rim).
    [[nodiscard]] static VelocityFreedoms with_inflow(const MembraneSpace& space, const MembraneState& state);
    /// Rim at rest, or a closed surface that moves freely.
    [[nodiscard]] static VelocityFreedoms of_the_curve(const MembraneSpace& space);

    [[nodiscard]] Index radial() const { return radial_count - fixed_radial; }
    [[nodiscard]] Index axial() const { return axial_count - fixed_axial; }
    [[nodiscard]] Index count() const { return radial() + axial(); }
    [[nodiscard]] Eigen::MatrixXd expand(const Eigen::MatrixXd& freedoms) const;  // column by column
    Eigen::MatrixXd restrict_columns(const Eigen::MatrixXd& matrix) const;        // M P
    Eigen::MatrixXd restrict_rows(const Eigen::MatrixXd& matrix) const;           // P^T M
    double through_rim(const Eigen::VectorXd& freedoms) const { return inflow ? freedoms[radial_count - 1] : 0.0; }
};

/// What a model says of one shape. Everything here depends on the curve alone.
struct MobilityOperators {
    MembraneSamples samples;  // of that shape
    VelocityFreedoms freedoms;
    Eigen::MatrixXd force_from_load;  // N^-1: force density coefficients from a load (freedoms); empty without a fluid
    Eigen::MatrixXd mobility;         // velocity freedoms from a load; positive definite up to the quadrature error
    RowMatrix wall_from_force;        // wall right-hand side per force coefficient; empty without walls
    RowMatrix wall_from_velocity;     // wall right-hand side per velocity coefficient (full)
};

struct FlowSolution {
    Eigen::VectorXd velocity;     // curve_count coefficients (u_r, u_z), nm/µs
    Eigen::VectorXd force;        // force_count coefficients of f, pN/nm²
    Multipliers multipliers;      // tension; pressure of a closed membrane
    Eigen::VectorXd load;         // freedoms: -(dE - inflow) + external - B^T multipliers, pN per 2π
    double inflow = 0.0;          // u_r(rim), nm/µs
    double power = 0.0;           // load . velocity = ∫ f.u dA, pN nm/µs
    double external_power = 0.0;  // of the external load, pN nm/µs
};

/// What every velocity must leave as it is.
struct Constraints {
    bool local_area = false;  // ∇_Γ·u = 0 (A.14), by the tension
    bool volume = false;      // inside a closed membrane, by the pressure
};

class FlowModel {
  public:
    FlowModel(const MembraneSpace& space, const Constraints& constraints) : space_(space), constraints_(constraints) {}
    virtual ~FlowModel() = default;
    FlowModel(const FlowModel&) = delete;
    FlowModel& operator=(const FlowModel&) = delete;

    [[nodiscard]] virtual MobilityOperators operators(const MembraneState& state,
                                                      const MembraneSamples& samples) const = 0;

    /// Velocity, force density and tension under the membrane's own elastic force and an external load (curve_count,
    /// pN per 2π; empty: none).
    [[nodiscard]] FlowSolution solve(const MobilityOperators& operators, const MembraneSamples& samples,
                                     const EnergyDerivatives& energy, double rim_energy_density,
                                     const Eigen::VectorXd& external = {}) const;

    /// B u = 0: weak surface divergence, then the volume. B's variation is at fixed u. Columns: freedoms of the
    /// velocity, all curve coefficients.
    [[nodiscard]] Eigen::MatrixXd constraint_matrix(const MembraneSamples& samples,
                                                    const VelocityFreedoms& freedoms) const;
    [[nodiscard]] Eigen::MatrixXd constraint_variation(const MembraneSamples& samples,
                                                       const Eigen::VectorXd& velocity) const;
    [[nodiscard]] bool keeps_local_area() const { return constraints_.local_area; }
    [[nodiscard]] bool constrained() const { return constraints_.local_area || constraints_.volume; }

  protected:
    [[nodiscard]] const MembraneSpace& space() const { return space_; }

  private:
    const MembraneSpace& space_;
    Constraints constraints_;
};

/// Independent balances of a solution, all relative and zero for the exact solution.
struct FlowBalances {
    double force = 0.0;     // total axial force of membrane and band over the sum of their moduli
    double net_flux = 0.0;  // volume flux out of both phases over the modulus of the flux through the membrane
    double area = 0.0;      // ∫ ∇_Γ·u dA over the inflow R a, or over ∫ |κ u.n| dA on a closed surface
};

}  // namespace endoflow::boundary_integral
