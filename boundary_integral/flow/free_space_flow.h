#pragma once

// Stokes flow in and around a closed membrane in unbounded fluid at rest far away.

#include "boundary_integral/flow/membrane_collocation.h"

namespace endoflow::boundary_integral {

class FreeSpaceFlow : public FlowModel {
  public:
    FreeSpaceFlow(const Parameters& parameters, const MembraneSpace& space);

    [[nodiscard]] MobilityOperators operators(const MembraneState& state,
                                              const MembraneSamples& samples) const override;

  private:
    MembraneCollocation collocation_;
    int threads_;
};

/// `samples`: the shape that moves with `flow`; that of the operators may be another, close one. Balances are relative
/// to what is balanced, or to `rest` where that is larger.
[[nodiscard]] FlowBalances flow_balances(const MembraneSpace& space, const MobilityOperators& operators,
                                         const MembraneSamples& samples, const FlowSolution& flow,
                                         const RestLevel& rest = {});

}  // namespace endoflow::boundary_integral
