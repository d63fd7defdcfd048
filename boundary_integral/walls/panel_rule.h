#pragma once

// How a layer on a panel of the walls is integrated.

#include <optional>

#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

/// The rule in τ for a target, `node` being its index when it is a wall node: about the target on its own panel, about
/// the closest point of a near one; none where the panel's own nodes do.
[[nodiscard]] std::optional<OffsetRule> panel_rule(const WallPanels& walls, const WallPanel& panel,
                                                   const Target& target, Index node, const QuadratureRule& base);

}  // namespace endoflow::boundary_integral
