#include "boundary_integral/fields/wall_sources.h"

namespace endoflow::boundary_integral {

namespace {

/// The eight Gauss points of a panel have 1e-8 from 0.7 of its length on: 3.1^-16, 3.1 the ellipse through the target.
constexpr WallQuadrature wall_quadrature{.near_distance = 0.7};

}  // namespace

WallSources::WallSources(const WallPanels& walls, const Eigen::VectorXd& unknowns)
    : walls_(walls), surface_(walls, wall_quadrature), nodes_(walls.nodes().size()) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Index row = 2 * static_cast<Index>(i);
        nodes_[i].u_r = unknowns[row];
        (walls.is_band(walls.nodes()[i]) ? nodes_[i].traction : nodes_[i].u_z) = unknowns[row + 1];
    }
    for (const WallPanel& panel : walls.panels()) {
        NodeValues* values = &nodes_[static_cast<std::size_t>(panel.first_node)];
        const Eigen::MatrixXd slopes = walls.lagrange_slopes(panel);
        for (Index i = 0; i < slopes.rows(); ++i) {
            for (Index j = 0; j < slopes.cols(); ++j) {
                values[i].u_r_slope += slopes(i, j) * values[j].u_r;
                values[i].u_z_slope += slopes(i, j) * values[j].u_z;
            }
        }
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const WallNode& node = walls.nodes()[i];
        const WallSegment& segment = walls.segments()[node.segment];
        rings_.push_back({{node.r, node.z, segment.normal_r, segment.normal_z},
                          density(segment, nodes_[i], node.r, node.speed, node.weight)});
    }
}

RingDensity WallSources::density(const WallSegment& segment, const NodeValues& v, double r, double speed,
                                 double weight) const {
    const double line = weight * r;
    const double area = line * speed;
    const double nu = segment.viscosity;
    const double tangent_r = (segment.r_end - segment.r_begin) / segment.length();
    const double tangent_z = (segment.z_end - segment.z_begin) / segment.length();
    // r ds (n ∇_Γ·u - (du/ds.n) t)
    const double divergence = line * (v.u_r_slope * tangent_r + v.u_z_slope * tangent_z) + weight * speed * v.u_r;
    const double turning = line * (v.u_r_slope * segment.normal_r + v.u_z_slope * segment.normal_z);
    return {0.0,
            line * v.traction,
            nu * area * v.u_r,
            nu * area * v.u_z,
            2.0 * nu * (segment.normal_r * divergence - turning * tangent_r),
            line * v.traction + 2.0 * nu * (segment.normal_z * divergence - turning * tangent_z)};
}

WallSources::NodeValues WallSources::interpolated(const WallPanel& panel, double tau) const {
    const std::vector<double> shape = walls_.lagrange(panel, tau);
    NodeValues v;
    for (std::size_t j = 0; j < shape.size(); ++j) {
        const NodeValues& node = nodes_[static_cast<std::size_t>(panel.first_node) + j];
        v.u_r += shape[j] * node.u_r;
        v.u_z += shape[j] * node.u_z;
        v.u_r_slope += shape[j] * node.u_r_slope;
        v.u_z_slope += shape[j] * node.u_z_slope;
        v.traction += shape[j] * node.traction;
    }
    return v;
}

void WallSources::add_to(RingLayers& layers, const Target& target) const {
    for (const WallPanel& panel : walls_.panels()) {
        const auto points = surface_.panel_points({.at = target}, panel);
        if (!points) {
            layers.add({&rings_[static_cast<std::size_t>(panel.first_node)], walls_.rule().nodes.size()});
            continue;
        }
        const WallSegment& segment = walls_.segments()[panel.segment];
        for (const PanelPoint& point : *points) {
            const ChargedRing charged{
                {point.r, target.z + point.delta_z, segment.normal_r, segment.normal_z},
                density(segment, interpolated(panel, point.tau), point.r, point.speed, point.weight)};
            layers.add({&charged, 1});
        }
    }
}

}  // namespace endoflow::boundary_integral
