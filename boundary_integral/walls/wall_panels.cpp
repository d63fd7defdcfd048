#include "boundary_integral/walls/wall_panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace endoflow::boundary_integral {

namespace {
constexpr double half_pi = 0.5 * std::numbers::pi;
}

double WallSegment::length() const {
    return std::hypot(r_end - r_begin, z_end - z_begin);
}

double WallSegment::normal_offset(const Target& target) const {
    return normal_r * (r_begin - target.r) + normal_z * (z_begin - target.z);
}

double WallSegment::fraction(double tau) const {
    const double sine = std::sin(half_pi * tau);
    return clustering == Clustering::both_ends ? sine * sine : sine;
}

double WallSegment::fraction_rate(double tau) const {
    return clustering == Clustering::both_ends ? half_pi * std::sin(2.0 * half_pi * tau)
                                               : half_pi * std::cos(half_pi * tau);
}

double WallSegment::fraction_difference(double tau, double offset) const {
    if (clustering == Clustering::both_ends) {
        return std::sin(half_pi * (2.0 * tau + offset)) * std::sin(half_pi * offset);
    }
    return 2.0 * std::cos(half_pi * (tau + 0.5 * offset)) * std::sin(0.5 * half_pi * offset);
}

WallPanels::WallPanels(const DomainParameters& domain, const FluidParameters& fluid, int nodes_per_panel)
    : rule_(gauss_legendre(nodes_per_panel)) {
    const double radius = domain.radius;
    const double height = domain.height;
    const double rim = domain.membrane_height;
    const double band = domain.pin_half_width;
    const double below = fluid.viscosity_extracellular;
    const double above = fluid.viscosity_intracellular;
    segments_ = {
        {0.0, 0.0, radius, 0.0, 0.0, -1.0, below, WallKind::free, Clustering::end, 2},
        {radius, 0.0, radius, rim - band, 1.0, 0.0, below, WallKind::free, Clustering::both_ends, 3},
        {radius, rim - band, radius, rim, 1.0, 0.0, below, WallKind::band, Clustering::both_ends, 2},
        {radius, rim, radius, rim + band, 1.0, 0.0, above, WallKind::band, Clustering::both_ends, 2},
        {radius, rim + band, radius, height, 1.0, 0.0, above, WallKind::free, Clustering::both_ends, 3},
        {0.0, height, radius, height, 0.0, 1.0, above, WallKind::free, Clustering::end, 2},
    };
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        const WallSegment& segment = segments_[s];
        const double step = 1.0 / segment.panels;
        for (int k = 0; k < segment.panels; ++k) {
            panels_.push_back({s, k * step, (k + 1) * step, static_cast<Index>(nodes_.size())});
            for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
                const double tau = (k + 0.5 * (1.0 + rule_.nodes[i])) * step;
                const double fraction = segment.fraction(tau);
                nodes_.push_back({s, tau, 0.5 * step * rule_.weights[i],
                                  segment.r_begin + fraction * (segment.r_end - segment.r_begin),
                                  segment.z_begin + fraction * (segment.z_end - segment.z_begin),
                                  segment.length() * segment.fraction_rate(tau)});
            }
        }
    }
    for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
        const double x = rule_.nodes[i];
        barycentric_.push_back((i % 2 == 0 ? 1.0 : -1.0) * std::sqrt((1.0 - x * x) * rule_.weights[i]));
    }
}

PanelApproach WallPanels::approach(const WallPanel& panel, const Target& target) const {
    // Closest point of the straight panel, through the fraction of the segment.
    const WallSegment& segment = segments_[panel.segment];
    const double length = segment.length();
    const double along = ((target.r - segment.r_begin) * (segment.r_end - segment.r_begin) +
                          (target.z - segment.z_begin) * (segment.z_end - segment.z_begin)) /
                         (length * length);
    const double low = segment.fraction(panel.tau_begin);
    const double high = segment.fraction(panel.tau_end);
    const double fraction = std::clamp(along, low, high);
    const double distance = std::hypot(segment.r_begin + fraction * (segment.r_end - segment.r_begin) - target.r,
                                       segment.z_begin + fraction * (segment.z_end - segment.z_begin) - target.z);
    double tau = segment.clustering == Clustering::both_ends
                     ? std::acos(std::clamp(1.0 - 2.0 * fraction, -1.0, 1.0)) / std::acos(-1.0)
                     : std::asin(std::clamp(fraction, 0.0, 1.0)) / std::acos(0.0);
    tau = std::clamp(tau, panel.tau_begin, panel.tau_end);
    // Where the map is stationary the width in τ is that of its quadratic part: whichever is smaller.
    const double speed = length * segment.fraction_rate(tau);
    const double curvature = length * std::acos(-1.0) * std::acos(-1.0) * 0.25;
    const double width = 1.0 / (speed / distance + std::sqrt(curvature / distance));
    return {distance, length * (high - low), tau, width};
}

std::vector<double> WallPanels::lagrange(const WallPanel& panel, double tau) const {
    const double x = 2.0 * (tau - panel.tau_begin) / (panel.tau_end - panel.tau_begin) - 1.0;
    std::vector<double> values(rule_.nodes.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double distance = x - rule_.nodes[i];
        if (distance == 0.0) {
            values.assign(values.size(), 0.0);
            values[i] = 1.0;
            return values;
        }
        values[i] = barycentric_[i] / distance;
        sum += values[i];
    }
    for (double& value : values) value /= sum;
    return values;
}

Eigen::MatrixXd WallPanels::lagrange_slopes(const WallPanel& panel) const {
    const std::size_t count = rule_.nodes.size();
    const double scale = 2.0 / (panel.tau_end - panel.tau_begin);
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Index>(count), static_cast<Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            if (j == i) continue;
            const double slope = scale * barycentric_[j] / barycentric_[i] / (rule_.nodes[i] - rule_.nodes[j]);
            slopes(static_cast<Index>(i), static_cast<Index>(j)) = slope;
            slopes(static_cast<Index>(i), static_cast<Index>(i)) -= slope;
        }
    }
    return slopes;
}

}  // namespace endoflow::boundary_integral
