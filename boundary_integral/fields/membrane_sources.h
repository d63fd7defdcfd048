#pragma once

// The membrane as layers of rings: the near-singular rule where a target is near, few rings where it is far.

#include <vector>

#include "boundary_integral/fields/ring_layers.h"
#include "boundary_integral/operators/membrane_surface.h"

namespace endoflow::boundary_integral {

/// Coefficients of what lives on the membrane.
struct MembraneFlow {
    Eigen::VectorXd velocity;  // curve_count, nm/µs
    Eigen::VectorXd force;     // force_count, of the membrane on the fluid, pN/nm²
};

class MembraneSources {
  public:
    /// contrast = ν₁ - ν₂, pN µs/nm². Space, state and samples must outlive the object.
    MembraneSources(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                    const MembraneFlow& flow, double contrast);

    void add_to(RingLayers& layers, const Target& target) const;

  private:
    /// Neighbouring elements that a distant target sees as few rings: their densities' moments up to a degree are kept.
    struct Cluster {
        Index first_element, elements;
        Target centre;
        double radius, length;  // nm
        std::vector<ChargedRing> rings;
    };

    const MembraneSpace& space_;
    const MembraneState& state_;
    const MembraneSamples& samples_;
    MembraneSurface surface_;
    double contrast_;
    Eigen::VectorXd u_r_, u_z_, f_r_, f_z_;
    std::vector<ChargedRing> rings_;  // at the Gauss points
    std::vector<Cluster> clusters_;

    [[nodiscard]] ChargedRing ring(const BasisRow& radial, const BasisRow& axial, const BasisRow& force,
                                   double weight) const;
    [[nodiscard]] Cluster cluster(Index first_element, Index elements) const;
    void add_element(RingLayers& layers, const Target& target, Index element) const;
};

}  // namespace endoflow::boundary_integral
