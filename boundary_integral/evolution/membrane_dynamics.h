#pragma once

// The membrane in the box as a system of ordinary differential equations y' = F(y), with the Jacobian an implicit
// integrator needs.

#include <Eigen/Core>

#include "boundary_integral/evolution/mesh_motion.h"
#include "boundary_integral/flow/box_flow.h"
#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/transport/surface_transport.h"
#include "shared/model/bending_model.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

// Everything that is computed on the way from a state vector to its rate of change.
struct Evaluation {
    MembraneState state;
    MembraneSamples samples;
    EnergyDerivatives energy;
    MobilityOperators operators;
    FlowSolution flow;
    std::vector<double> relative_velocity;  // of the material against the mesh, tangential, at the Gauss points, nm/us
    Eigen::VectorXd mesh_velocity;          // curve_count, nm/us
    Eigen::VectorXd rate;                   // F(y)
};

// y = (r coefficients without the rim's, z coefficients without the last two, moments of c). The rim's height, its
// slope and its radius do not move.
class MembraneDynamics {
  public:
    explicit MembraneDynamics(const Parameters& parameters);

    const MembraneSpace& space() const { return space_; }
    const BoxFlow& box() const { return box_; }
    const BendingModel& model() const { return model_; }
    Index size() const { return space_.curve_count() - 3 + space_.axial_count(); }

    // Flat membrane with the coat's equilibrium profile on a mesh that resolves it.
    Eigen::VectorXd initial_vector() const;

    MembraneState unpack(const Eigen::VectorXd& y) const;
    Evaluation evaluate(const Eigen::VectorXd& y) const;

    // dF/dy with the boundary-integral operators frozen: exact Hessian of the energy and of the constraint, exact
    // transport.
    Eigen::MatrixXd jacobian(const Evaluation& evaluation) const;

    // Absolute errors that count as one unit: `length` for coefficients of the curve, `concentration` for those of c.
    Eigen::VectorXd error_scales(const Eigen::VectorXd& y, double length, double concentration) const;

  private:
    Parameters parameters_;
    MembraneSpace space_;
    BendingModel model_;
    BoxFlow box_;
    MeshMotion mesh_;

    Index free_radial() const { return space_.radial_count() - 1; }
    Index free_axial() const { return space_.axial_count() - 2; }
    Eigen::VectorXd pack(const Eigen::VectorXd& curve, const Eigen::VectorXd& moments) const;
    Eigen::MatrixXd pack_rows(const Eigen::MatrixXd& curve_rows) const;
    Eigen::MatrixXd pack_columns(const Eigen::MatrixXd& curve_columns) const;
};

}  // namespace endoflow::boundary_integral
