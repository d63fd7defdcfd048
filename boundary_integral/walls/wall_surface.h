#pragma once

// How layers on the walls are integrated: nodes of panels that are far from the target, a rule about its closest point
// on near ones, about itself on its own.

#include <optional>
#include <span>
#include <vector>

#include "boundary_integral/operators/surface_points.h"
#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

/// The wall-wall block is built once and decides the balance of forces (1e-11): it gets the finer rule. Targets off the
/// walls see them through the coarser one.
struct WallQuadrature {
    int points = 32;             // per side of a target's closest point
    int points_of_nodes = 40;    // per side, where the target is a node of the walls
    double near_distance = 1.2;  // in panel lengths
};

/// With ℓ the Lagrange polynomials through a panel's nodes and ν its fluid's viscosity.
enum WallTable : std::size_t {
    lateral_table,   // ν ℓ: of u_r and u_φ
    vertical_table,  // ν ℓ on free walls, 0 in the band: of u_z
    traction_table,  // ℓ dτ/ds in the band, 0 on free walls: of the unknown t_z ds/dτ
    frame_table      // one function, 1 in the band and 0 on free walls: of a uniform traction
};

/// A point of a rule on a panel, as a target sees it.
struct PanelPoint {
    double tau;
    double r;                 // nm
    double delta_r, delta_z;  // point - target [nm], to full relative accuracy on the target's own segment
    double speed;             // ds/dτ, nm
    double weight;            // dτ
};

class WallSurface {
  public:
    /// The walls must outlive the object.
    explicit WallSurface(const WallPanels& walls, const WallQuadrature& quadrature = {});

    [[nodiscard]] const SurfacePoints& nodes() const { return nodes_; }

    /// What to integrate a panel with where its nodes do not serve this target.
    [[nodiscard]] std::optional<SurfacePoints> points(const LayerTarget& target, Index panel) const;

    /// The points alone; none where the panel's nodes serve.
    [[nodiscard]] std::optional<std::vector<PanelPoint>> panel_points(const LayerTarget& target,
                                                                      const WallPanel& panel) const;

  private:
    const WallPanels& walls_;
    QuadratureRule rule_, rule_of_nodes_;
    double near_distance_;
    SurfacePoints nodes_;

    [[nodiscard]] std::optional<OffsetRule> rule(const LayerTarget& target, const WallPanel& panel) const;
    [[nodiscard]] std::vector<BasisTable> empty_tables(std::size_t points) const;
    template <class Point>
    void add_functions(const WallPanel& panel, std::span<const Point> points, std::vector<BasisTable>& basis) const;
};

}  // namespace endoflow::boundary_integral
