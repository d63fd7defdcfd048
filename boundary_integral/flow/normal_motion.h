#pragma once

// Motion without a fluid: every point of the membrane moves along its normal with
//     V_n = M_n F.n                                             (the sharp form of (35) with u = 0)
// The velocity is the gradient flow of the discrete energy in the degenerate metric that only normal motion counts in:
//     u = M_n N^-1 P N^-1 load,   N = ∫ w.w' dA,  P = ∫ (w.n)(w'.n) dA,
// so the energy falls by exactly load.u per time.

#include "boundary_integral/flow/flow_model.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

class NormalMotion : public FlowModel {
  public:
    NormalMotion(const Parameters& parameters, const MembraneSpace& space)
        : FlowModel(space, {}), mobility_(parameters.fluid.normal_mobility) {}

    [[nodiscard]] MobilityOperators operators(const MembraneState& state,
                                              const MembraneSamples& samples) const override;

  private:
    double mobility_;  // nm³/(pN µs)
};

}  // namespace endoflow::boundary_integral
