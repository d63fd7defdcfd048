#pragma once

// The membrane in the box as a system of ordinary differential equations y' = F(t, y), with the Jacobian an implicit
// integrator needs. Time enters by the coat's maturity; and F is another one when a collar has been placed.

#include <Eigen/Core>
#include <memory>

#include "boundary_integral/evolution/mesh_motion.h"
#include "boundary_integral/flow/box_flow.h"
#include "boundary_integral/flow/flow_model.h"
#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/membrane/external_loads.h"
#include "boundary_integral/transport/surface_exchange.h"
#include "boundary_integral/transport/surface_transport.h"
#include "shared/model/bending_model.h"
#include "shared/model/maturation.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

/// Everything that is computed on the way from a state vector to its rate of change.
struct Evaluation {
    double time;  // µs
    MembraneState state;
    MembraneSamples samples;
    EnergyDerivatives energy;
    std::shared_ptr<const MobilityOperators> operators;
    FlowSolution flow;
    std::vector<double> relative_velocity;  // of the material against the mesh, tangential, at the Gauss points, nm/µs
    Eigen::VectorXd mesh_velocity;          // curve_count, nm/µs
    Eigen::VectorXd diffusion, exchange;    // rates of the moments by either
    Eigen::VectorXd rate;                   // F(t, y)
};

/// y = (r coefficients, z coefficients, moments of c). The rim's radius, its height and its slope do not move: their
/// coefficients are left out.
class MembraneDynamics {
  public:
    explicit MembraneDynamics(const Parameters& parameters);

    [[nodiscard]] const MembraneSpace& space() const { return space_; }
    [[nodiscard]] const FlowModel& flow_model() const { return *flow_; }
    /// nullptr without walls.
    [[nodiscard]] const BoxFlow* box() const { return dynamic_cast<const BoxFlow*>(flow_.get()); }
    [[nodiscard]] BendingModel model(double time) const { return bending_model(parameters_, time); }
    [[nodiscard]] const MaturationLaw& maturation() const { return maturation_; }
    [[nodiscard]] const TransportLaw& transport() const { return transport_; }
    [[nodiscard]] const Loads& loads() const { return loads_; }
    /// From now on the collar sits on the material with this area between it and the pole [nm²].
    void place_collar(double area) { loads_.collar_place = area; }
    [[nodiscard]] Index size() const { return free_radial() + free_axial() + space_.axial_count(); }

    /// Flat membrane or spheroid with the coat's equilibrium profile on a mesh that resolves it.
    [[nodiscard]] Eigen::VectorXd initial_vector() const;

    [[nodiscard]] MembraneState unpack(const Eigen::VectorXd& y) const;
    [[nodiscard]] Eigen::VectorXd packed(const MembraneState& state) const;
    [[nodiscard]] Evaluation evaluate(double time, const Eigen::VectorXd& y) const {
        return evaluate(time, y, operators(y));
    }

    /// The hydrodynamic operators cost far more than the rest and depend smoothly on the shape: they may be taken from
    /// a shape that is known to be close.
    [[nodiscard]] std::shared_ptr<const MobilityOperators> operators(const Eigen::VectorXd& y) const;
    [[nodiscard]] Evaluation evaluate(double time, const Eigen::VectorXd& y,
                                      std::shared_ptr<const MobilityOperators> operators) const;

    /// E_c of the coat's edge, pN nm.
    [[nodiscard]] double line_energy(const MembraneState& state) const;

    /// Molecules that come onto the membrane, nm² of coat per µs.
    [[nodiscard]] double exchanged_per_time(double time, const Eigen::VectorXd& y) const;

    /// The power of maturation ∂E/∂χ dχ/dt, pN nm/µs.
    [[nodiscard]] double maturation_power(const Evaluation& evaluation) const;

    /// dF/dy at fixed operators, exact.
    [[nodiscard]] Eigen::MatrixXd jacobian(const Evaluation& evaluation) const;

    /// Absolute errors that count as one unit: `length` for coefficients of the curve, `concentration` for those of c.
    [[nodiscard]] Eigen::VectorXd error_scales(const Eigen::VectorXd& y, double length, double concentration) const;

  private:
    Parameters parameters_;
    MembraneSpace space_;
    MaturationLaw maturation_;
    Loads loads_;
    TransportLaw transport_;
    ExchangeLaw exchange_;
    std::unique_ptr<FlowModel> flow_;
    MeshMotion mesh_;

    [[nodiscard]] Index free_radial() const { return space_.radial_count() - space_.fixed_radial(); }
    [[nodiscard]] Index free_axial() const { return space_.axial_count() - space_.fixed_axial(); }
    [[nodiscard]] Eigen::VectorXd pack(const Eigen::VectorXd& curve, const Eigen::VectorXd& moments) const;
    [[nodiscard]] Eigen::MatrixXd pack_rows(const Eigen::MatrixXd& curve_rows) const;
    [[nodiscard]] Eigen::MatrixXd pack_columns(const Eigen::MatrixXd& curve_columns) const;
};

}  // namespace endoflow::boundary_integral
