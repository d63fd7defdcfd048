#pragma once

// The outer walls as layers of rings, with the near-singular rule where a target is near.

#include <vector>

#include "boundary_integral/fields/ring_layers.h"
#include "boundary_integral/walls/wall_surface.h"

namespace endoflow::boundary_integral {

class WallSources {
  public:
    /// `unknowns` as WallPanels numbers them. The walls must outlive the object.
    WallSources(const WallPanels& walls, const Eigen::VectorXd& unknowns);

    void add_to(RingLayers& layers, const Target& target) const;

  private:
    /// What a node carries; everything per dτ.
    struct NodeValues {
        double u_r = 0.0, u_z = 0.0;              // nm/µs
        double u_r_slope = 0.0, u_z_slope = 0.0;  // d/dτ
        double traction = 0.0;                    // t_z ds/dτ in the band, pN/nm
    };

    const WallPanels& walls_;
    WallSurface surface_;
    std::vector<NodeValues> nodes_;
    std::vector<ChargedRing> rings_;  // at the nodes

    [[nodiscard]] RingDensity density(const WallSegment& segment, const NodeValues& values, double r, double speed,
                                      double weight) const;
    [[nodiscard]] NodeValues interpolated(const WallPanel& panel, double tau) const;
};

}  // namespace endoflow::boundary_integral
