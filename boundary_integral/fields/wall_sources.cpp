#include "boundary_integral/fields/wall_sources.h"

#include <cmath>

#include "boundary_integral/quadrature/singular_rules.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int near_points = 32;  // per side of the closest point
/// The eight Gauss points of a panel have 1e-8 from 0.7 of its length on: 3.1^-16, 3.1 the ellipse through the target.
constexpr double near_distance = 0.7;  // in panel lengths

/// d(i, j): derivative at node i of the Lagrange polynomial of node j.
Eigen::MatrixXd differentiation_matrix(const std::vector<double>& nodes) {
    const Index count = static_cast<Index>(nodes.size());
    const auto x = [&](Index i) { return nodes[static_cast<std::size_t>(i)]; };
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(count);  // barycentric
    for (Index i = 0; i < count; ++i) {
        for (Index j = 0; j < count; ++j) {
            if (j != i) weights[i] /= x(i) - x(j);
        }
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    for (Index i = 0; i < count; ++i) {
        for (Index j = 0; j < count; ++j) {
            if (j == i) continue;
            matrix(i, j) = weights[j] / weights[i] / (x(i) - x(j));
            matrix(i, i) -= matrix(i, j);
        }
    }
    return matrix;
}

}  // namespace

WallSources::WallSources(const WallPanels& walls, const Eigen::VectorXd& unknowns)
    : walls_(walls), near_rule_(gauss_legendre(near_points)), nodes_(walls.nodes().size()) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Index row = 2 * static_cast<Index>(i);
        nodes_[i].u_r = unknowns[row];
        (walls.is_band(walls.nodes()[i]) ? nodes_[i].traction : nodes_[i].u_z) = unknowns[row + 1];
    }
    const Eigen::MatrixXd derivative = differentiation_matrix(walls.rule().nodes);
    for (const WallPanel& panel : walls.panels()) {
        NodeValues* values = &nodes_[static_cast<std::size_t>(panel.first_node)];
        const double scale = 2.0 / (panel.tau_end - panel.tau_begin);
        for (Index i = 0; i < derivative.rows(); ++i) {
            for (Index j = 0; j < derivative.cols(); ++j) {
                values[i].u_r_slope += scale * derivative(i, j) * values[j].u_r;
                values[i].u_z_slope += scale * derivative(i, j) * values[j].u_z;
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

void WallSources::add_to(RingLayers& layers, const Target& target) const {
    for (const WallPanel& panel : walls_.panels()) {
        const PanelApproach approach = walls_.approach(panel, target);
        if (approach.distance <= near_distance * approach.length) {
            add_near_panel(layers, panel, approach);
            continue;
        }
        layers.add({&rings_[static_cast<std::size_t>(panel.first_node)], walls_.rule().nodes.size()});
    }
}

void WallSources::add_near_panel(RingLayers& layers, const WallPanel& panel, const PanelApproach& approach) const {
    const WallSegment& segment = walls_.segments()[panel.segment];
    const OffsetRule rule =
        near_singular_rule(panel.tau_begin, panel.tau_end, approach.tau, approach.width, near_rule_);
    for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
        const double tau = rule.origin + rule.offsets[i];
        const double fraction = segment.fraction(tau);
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
        const double r = segment.r_begin + fraction * (segment.r_end - segment.r_begin);
        const double z = segment.z_begin + fraction * (segment.z_end - segment.z_begin);
        const ChargedRing charged{
            {r, z, segment.normal_r, segment.normal_z},
            density(segment, v, r, segment.length() * segment.fraction_rate(tau), rule.weights[i])};
        layers.add({&charged, 1});
    }
}

}  // namespace endoflow::boundary_integral
