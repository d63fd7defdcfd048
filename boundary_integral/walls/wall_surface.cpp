#include "boundary_integral/walls/wall_surface.h"

#include <array>
#include <numeric>

namespace endoflow::boundary_integral {

WallSurface::WallSurface(const WallPanels& walls, const WallQuadrature& quadrature)
    : walls_(walls),
      rule_(gauss_legendre(quadrature.points)),
      rule_of_nodes_(gauss_legendre(quadrature.points_of_nodes)),
      near_distance_(quadrature.near_distance) {
    nodes_.basis = empty_tables(walls.nodes().size());
    nodes_.pieces = static_cast<Index>(walls.panels().size());
    for (const WallPanel& panel : walls.panels()) {
        const WallSegment& segment = walls.segments()[panel.segment];
        const std::span nodes(&walls.nodes()[at(panel.first_node)], walls.rule().nodes.size());
        for (const WallNode& node : nodes) {
            const double weight = node.weight * node.r * node.speed;
            nodes_.add_node(node.r, node.z, segment.normal_r, segment.normal_z, weight);
        }
        add_functions(panel, nodes, nodes_.basis);
    }
}

std::vector<BasisTable> WallSurface::empty_tables(std::size_t points) const {
    std::vector<BasisTable> tables;
    for (const WallTable table : {lateral_table, vertical_table, traction_table, frame_table})
        tables.emplace_back(table == frame_table ? 1 : walls_.rule().nodes.size(), points);
    return tables;
}

template <class Point>
void WallSurface::add_functions(const WallPanel& panel, std::span<const Point> points,
                                std::vector<BasisTable>& basis) const {
    const WallSegment& segment = walls_.segments()[panel.segment];
    const double free = segment.kind == WallKind::free ? 1.0 : 0.0, band = 1.0 - free;
    std::vector<Index> index(walls_.rule().nodes.size());
    std::iota(index.begin(), index.end(), panel.first_node);
    for (const WallTable table : {lateral_table, vertical_table, traction_table}) basis[table].begin_piece(index);
    basis[frame_table].begin_piece(std::array<Index, 1>{0});
    for (const Point& point : points) {
        const std::vector<double> shape = walls_.lagrange(panel, point.tau);
        basis[lateral_table].add(shape, segment.viscosity);
        basis[vertical_table].add(shape, free * segment.viscosity);
        basis[traction_table].add(shape, band / point.speed);
        basis[frame_table].add(std::array{band});
    }
}

std::optional<OffsetRule> WallSurface::rule(const LayerTarget& target, const WallPanel& panel) const {
    const QuadratureRule& base = target.node >= 0 ? rule_of_nodes_ : rule_;
    const auto count = static_cast<Index>(walls_.rule().nodes.size());
    if (target.node >= panel.first_node && target.node < panel.first_node + count)
        return logarithmic_rule(panel.tau_begin, panel.tau_end, walls_.nodes()[at(target.node)].tau, base);
    const PanelApproach approach = walls_.approach(panel, target.at);
    if (approach.distance > near_distance_ * approach.length) return std::nullopt;
    return near_singular_rule(panel.tau_begin, panel.tau_end, approach.tau, approach.width, base);
}

std::optional<std::vector<PanelPoint>> WallSurface::panel_points(const LayerTarget& target,
                                                                 const WallPanel& panel) const {
    const std::optional<OffsetRule> offsets = rule(target, panel);
    if (!offsets) return std::nullopt;
    const WallSegment& segment = walls_.segments()[panel.segment];
    const double length_r = segment.r_end - segment.r_begin, length_z = segment.z_end - segment.z_begin;
    const WallNode* own = target.node >= 0 ? &walls_.nodes()[at(target.node)] : nullptr;
    if (own != nullptr && own->segment != panel.segment) own = nullptr;
    std::vector<PanelPoint> points;
    points.reserve(offsets->offsets.size());
    for (std::size_t i = 0; i < offsets->offsets.size(); ++i) {
        const double tau = offsets->origin + offsets->offsets[i], fraction = segment.fraction(tau);
        const double r = segment.r_begin + fraction * length_r, z = segment.z_begin + fraction * length_z;
        PanelPoint point{tau,
                         r,
                         r - target.at.r,
                         z - target.at.z,
                         segment.length() * segment.fraction_rate(tau),
                         offsets->weights[i]};
        if (own != nullptr) {
            const double along =
                segment.fraction_difference(own->tau, (offsets->origin - own->tau) + offsets->offsets[i]);
            point.delta_r = along * length_r;
            point.delta_z = along * length_z;
        }
        points.push_back(point);
    }
    return points;
}

std::optional<SurfacePoints> WallSurface::points(const LayerTarget& target, Index index) const {
    const WallPanel& panel = walls_.panels()[at(index)];
    const auto on_panel = panel_points(target, panel);
    if (!on_panel) return std::nullopt;
    const WallSegment& segment = walls_.segments()[panel.segment];
    SurfacePoints points;
    points.basis = empty_tables(on_panel->size());
    for (const PanelPoint& point : *on_panel) {
        // The normal offset is constant on a straight segment, exactly zero on the target's own line.
        points.add(point.r, point.delta_r, point.delta_z, segment.normal_r, segment.normal_offset(target.at),
                   point.weight * point.r * point.speed);
    }
    add_functions<PanelPoint>(panel, *on_panel, points.basis);
    return points;
}

}  // namespace endoflow::boundary_integral
