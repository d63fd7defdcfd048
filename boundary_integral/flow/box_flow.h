#pragma once

// Stokes flow in the box that a membrane of given shape, concentration and law drives, with walls, pin band, viscosity
// contrast, inextensibility and inflow through the rim.

#include <Eigen/Core>
#include <vector>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/flow/membrane_collocation.h"
#include "boundary_integral/walls/wall_layers.h"

namespace endoflow::boundary_integral {

class BoxFlow : public FlowModel {
  public:
    BoxFlow(const Parameters& parameters, const MembraneSpace& space);

    [[nodiscard]] const WallPanels& walls() const { return walls_; }

    [[nodiscard]] MobilityOperators operators(const MembraneState& state,
                                              const MembraneSamples& samples) const override;

    /// Wall unknowns (see WallPanels) that go with a solution.
    [[nodiscard]] Eigen::VectorXd wall_unknowns(const MobilityOperators& operators, const FlowSolution& flow) const;

    [[nodiscard]] int threads() const { return threads_; }

  private:
    MembraneCollocation collocation_;
    WallPanels walls_;
    int threads_;
    std::vector<LayerTarget> wall_targets_;
    RowMatrix wall_inverse_;  // A_w^-1
};

/// `samples`: the shape that moves with `flow`; that of the operators may be another, close one. Balances are relative
/// to what is balanced, or to `rest` where that is larger.
[[nodiscard]] FlowBalances flow_balances(const MembraneSpace& space, const BoxFlow& box,
                                         const MobilityOperators& operators, const MembraneSamples& samples,
                                         const FlowSolution& flow, const RestLevel& rest = {});

}  // namespace endoflow::boundary_integral
