#include "boundary_integral/fields/membrane_sources.h"

#include <algorithm>
#include <cmath>

#include "boundary_integral/operators/closest_point.h"

namespace endoflow::boundary_integral {

namespace {

constexpr LayerQuadrature quadrature{.near_points = 24};

/// From 2.5 lengths of a cluster on, the parts of its kernels above the fifth degree are below 2e-6 of them.
constexpr Index cluster_elements = 4;
constexpr int cluster_points = 6;
constexpr double far_distance = 2.5;  // in lengths of the cluster

/// T(i, j): a density at Gauss points, weighted, is replaced at the cluster's points by one with the same moments
/// against polynomials. The points are in (-1, 1).
Eigen::MatrixXd moment_transfer(const QuadratureRule& to, const std::vector<double>& from) {
    const auto legendre = [](const std::vector<double>& points, Index count) {
        Eigen::MatrixXd values(static_cast<Index>(points.size()), count);
        for (Index i = 0; i < values.rows(); ++i) {
            const double x = points[static_cast<std::size_t>(i)];
            values(i, 0) = 1.0;
            values(i, 1) = x;
            for (Index k = 2; k < count; ++k) {
                const auto n = static_cast<double>(k);
                values(i, k) = ((2.0 * n - 1.0) * x * values(i, k - 1) - (n - 1.0) * values(i, k - 2)) / n;
            }
        }
        return values;
    };
    const auto count = static_cast<Index>(to.nodes.size());
    Eigen::MatrixXd there = legendre(to.nodes, count);
    for (Index k = 0; k < count; ++k) there.col(k) *= static_cast<double>(k) + 0.5;  // over Legendre's square norm
    const Eigen::Map<const Eigen::VectorXd> weights(to.weights.data(), count);
    return weights.asDiagonal() * there * legendre(from, count).transpose();
}

RingPoint ring_point(const CurvePoint& p) {
    return {p.r, p.z, p.normal_r, p.normal_z};
}

}  // namespace

MembraneSources::MembraneSources(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                                 const MembraneFlow& flow, double contrast)
    : space_(space),
      state_(state),
      samples_(samples),
      surface_(space, state, samples, membrane_functions(space), quadrature),
      contrast_(contrast),
      u_r_(flow.velocity.head(space.radial_count())),
      u_z_(flow.velocity.tail(space.axial_count())),
      f_r_(flow.force.head(space.radial_count())),
      f_z_(flow.force.tail(space.force().dimension())) {
    for (std::size_t i = 0; i < samples.curve.size(); ++i)
        rings_.push_back(ring(space.radial_rows[i], space.axial_rows[i], space.force_rows[i], space.weight[i]));
    for (Index first = 0; first < space.elements(); first += cluster_elements)
        clusters_.push_back(cluster(first, std::min(cluster_elements, space.elements() - first)));
}

MembraneSources::Cluster MembraneSources::cluster(Index first_element, Index elements) const {
    Cluster result{first_element, elements, {}, 0.0, 0.0, {}};
    const double begin = static_cast<double>(first_element) * space_.element_width();
    const double half = 0.5 * static_cast<double>(elements) * space_.element_width();
    const auto first = static_cast<std::size_t>(first_element * space_.points_per_element());
    const auto count = static_cast<std::size_t>(elements * space_.points_per_element());
    std::vector<double> places;
    for (std::size_t i = first; i < first + count; ++i) {
        places.push_back((space_.xi[i] - begin) / half - 1.0);
        result.centre.r += samples_.curve[i].r / static_cast<double>(count);
        result.centre.z += samples_.curve[i].z / static_cast<double>(count);
    }
    for (Index e = first_element; e < first_element + elements; ++e) result.length += surface_.length(e);
    for (std::size_t i = first; i < first + count; ++i)
        result.radius = std::max(result.radius, std::sqrt(squared_distance(samples_.curve[i], result.centre)));
    const QuadratureRule rule = gauss_legendre(cluster_points);
    const Eigen::MatrixXd transfer = moment_transfer(rule, places);
    for (Index k = 0; k < cluster_points; ++k) {
        const double xi = begin + half * (1.0 + rule.nodes[static_cast<std::size_t>(k)]);
        RingDensity sum{};
        for (std::size_t i = 0; i < count; ++i) {
            const RingDensity& d = rings_[first + i].density;
            const double part = transfer(k, static_cast<Index>(i));
            sum.force_r += part * d.force_r;
            sum.force_z += part * d.force_z;
            sum.momentum_r += part * d.momentum_r;
            sum.momentum_z += part * d.momentum_z;
            sum.pressure_r += part * d.pressure_r;
            sum.pressure_z += part * d.pressure_z;
        }
        result.rings.push_back(
            {ring_point(curve_point(space_.radial().basis(xi), space_.axial().basis(xi), state_)), sum});
    }
    return result;
}

ChargedRing MembraneSources::ring(const BasisRow& radial, const BasisRow& axial, const BasisRow& force,
                                  double weight) const {
    const CurvePoint p = curve_point(radial, axial, state_);
    const double measure = weight * p.r * p.g;
    const double u_r = radial.evaluate(u_r_), u_z = axial.evaluate(u_z_);
    const double f_r = radial.evaluate(f_r_), f_z = force.evaluate(f_z_);
    const double slope_r = radial.evaluate(u_r_, 1) / p.g, slope_z = axial.evaluate(u_z_, 1) / p.g;  // du/ds
    const double tangent_r = p.r1 / p.g, tangent_z = p.z1 / p.g;
    const double divergence = slope_r * tangent_r + slope_z * tangent_z + u_r / p.r;
    const double turning = slope_r * p.normal_r + slope_z * p.normal_z;
    const double q_r = f_r + 2.0 * contrast_ * (p.normal_r * divergence - turning * tangent_r);
    const double q_z = f_z + 2.0 * contrast_ * (p.normal_z * divergence - turning * tangent_z);
    return {ring_point(p),
            {measure * f_r, measure * f_z, measure * contrast_ * u_r, measure * contrast_ * u_z, measure * q_r,
             measure * q_z}};
}

void MembraneSources::add_to(RingLayers& layers, const Target& target) const {
    for (const Cluster& cluster : clusters_) {
        const double distance = std::hypot(cluster.centre.r - target.r, cluster.centre.z - target.z) - cluster.radius;
        if (distance > far_distance * cluster.length) {
            layers.add(cluster.rings);
            continue;
        }
        for (Index e = 0; e < cluster.elements; ++e) add_element(layers, target, cluster.first_element + e);
    }
}

void MembraneSources::add_element(RingLayers& layers, const Target& target, Index element) const {
    const auto near = surface_.near_points(target, element);
    if (!near) {
        const auto count = static_cast<std::size_t>(space_.points_per_element());
        layers.add({&rings_[static_cast<std::size_t>(element) * count], count});
        return;
    }
    for (std::size_t i = 0; i < near->rule.weights.size(); ++i) {
        const ChargedRing charged = ring(near->rows[radial_table][i], near->rows[axial_table][i],
                                         near->rows[force_table][i], near->rule.weights[i]);
        layers.add({&charged, 1});
    }
}

}  // namespace endoflow::boundary_integral
