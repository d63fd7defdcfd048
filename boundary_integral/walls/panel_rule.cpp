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

std::vector<PanelPoint> points_on_panel(const WallPanels& walls, const WallPanel& panel, const Target& target,
                                        Index node, const OffsetRule& rule) {
    const WallSegment& segment = walls.segments()[panel.segment];
    const double length_r = segment.r_end - segment.r_begin, length_z = segment.z_end - segment.z_begin;
    const WallNode* own = node >= 0 ? &walls.nodes()[static_cast<std::size_t>(node)] : nullptr;
    if (own != nullptr && own->segment != panel.segment) own = nullptr;
    std::vector<PanelPoint> points;
    for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
        const double tau = rule.origin + rule.offsets[i], fraction = segment.fraction(tau);
        const double r = segment.r_begin + fraction * length_r, z = segment.z_begin + fraction * length_z;
        PanelPoint point{
            tau, r, r - target.r, z - target.z, segment.length() * segment.fraction_rate(tau), rule.weights[i]};
        if (own != nullptr) {
            const double offset = segment.fraction_difference(own->tau, (rule.origin - own->tau) + rule.offsets[i]);
            point.delta_r = offset * length_r;
            point.delta_z = offset * length_z;
        }
        points.push_back(point);
    }
    return points;
}

}  // namespace endoflow::boundary_integral
