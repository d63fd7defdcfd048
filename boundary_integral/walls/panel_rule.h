#pragma once

// How a layer on a panel of the walls is integrated.

#include <optional>
#include <vector>

#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

/// The rule in τ for a target, `node` being its index when it is a wall node: about the target on its own panel, about
/// the closest point of a near one; none where the panel's own nodes do.
[[nodiscard]] std::optional<OffsetRule> panel_rule(const WallPanels& walls, const WallPanel& panel,
                                                   const Target& target, Index node, const QuadratureRule& base);

/// A point of a rule on a panel, as a target sees it.
struct PanelPoint {
    double tau;
    double r;                 // nm
    double delta_r, delta_z;  // point - target [nm], to full relative accuracy on the target's own segment
    double speed;             // ds/dτ, nm
    double weight;            // dτ
};

[[nodiscard]] std::vector<PanelPoint> points_on_panel(const WallPanels& walls, const WallPanel& panel,
                                                      const Target& target, Index node, const OffsetRule& rule);

}  // namespace endoflow::boundary_integral
