#include "boundary_integral/walls/panel_rule.h"

namespace endoflow::boundary_integral {

namespace {
constexpr double near_distance = 1.2;  // in panel lengths
}

std::optional<OffsetRule> panel_rule(const WallPanels& walls, const WallPanel& panel, const Target& target, Index node,
                                     const QuadratureRule& base) {
    if (node >= panel.first_node && node < panel.first_node + static_cast<Index>(walls.rule().nodes.size())) {
        const double tau = walls.nodes()[static_cast<std::size_t>(node)].tau;
        return logarithmic_rule(panel.tau_begin, panel.tau_end, tau, base);
    }
    const PanelApproach approach = walls.approach(panel, target);
    if (approach.distance > near_distance * approach.length) return std::nullopt;
    return near_singular_rule(panel.tau_begin, panel.tau_end, approach.tau, approach.width, base);
}

}  // namespace endoflow::boundary_integral
