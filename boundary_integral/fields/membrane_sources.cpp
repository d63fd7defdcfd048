#include "boundary_integral/fields/membrane_sources.h"

#include <algorithm>
#include <cmath>

#include "boundary_integral/operators/closest_point.h"
#include "boundary_integral/quadrature/singular_rules.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int near_points = 24;           // per side of the closest point
constexpr double near_distance = 1.0;     // in element lengths
constexpr double least_distance = 1e-12;  // nm

RingPoint ring(const CurvePoint& p) {
    return {p.r, p.z, p.normal_r, p.normal_z};
}

}  // namespace

MembraneSources::MembraneSources(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                                 const MembraneFlow& flow, double contrast)
    : space_(space),
      state_(state),
      samples_(samples),
      contrast_(contrast),
      u_r_(flow.velocity.head(space.radial_count())),
      u_z_(flow.velocity.tail(space.axial_count())),
      f_r_(flow.force.head(space.radial_count())),
      f_z_(flow.force.tail(space.force().dimension())),
      near_rule_(gauss_legendre(near_points)),
      lengths_(static_cast<std::size_t>(space.elements()), 0.0) {
    for (std::size_t i = 0; i < samples.curve.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        densities_.push_back(
            density(p, space.radial_rows[i], space.axial_rows[i], space.force_rows[i], space.weight[i]));
        lengths_[i / static_cast<std::size_t>(space.points_per_element())] += space.weight[i] * p.g;
    }
}

RingDensity MembraneSources::density(const CurvePoint& p, const BasisRow& radial, const BasisRow& axial,
                                     const BasisRow& force, double weight) const {
    const double measure = weight * p.r * p.g;
    const double u_r = radial.evaluate(u_r_), u_z = axial.evaluate(u_z_);
    const double f_r = radial.evaluate(f_r_), f_z = force.evaluate(f_z_);
    const double slope_r = radial.evaluate(u_r_, 1) / p.g, slope_z = axial.evaluate(u_z_, 1) / p.g;  // du/ds
    const double tangent_r = p.r1 / p.g, tangent_z = p.z1 / p.g;
    const double divergence = slope_r * tangent_r + slope_z * tangent_z + u_r / p.r;
    const double turning = slope_r * p.normal_r + slope_z * p.normal_z;
    const double q_r = f_r + 2.0 * contrast_ * (p.normal_r * divergence - turning * tangent_r);
    const double q_z = f_z + 2.0 * contrast_ * (p.normal_z * divergence - turning * tangent_z);
    return {measure * f_r, measure * f_z, measure * contrast_ * u_r, measure * contrast_ * u_z,
            measure * q_r, measure * q_z};
}

void MembraneSources::add_to(RingLayers& layers, const Target& target) const {
    const auto per_element = static_cast<std::size_t>(space_.points_per_element());
    for (Index element = 0; element < space_.elements(); ++element) {
        const std::size_t first = static_cast<std::size_t>(element) * per_element;
        double closest = 1e300;
        std::size_t closest_point = first;
        for (std::size_t i = first; i < first + per_element; ++i) {
            const double distance = squared_distance(samples_.curve[i], target);
            if (distance < closest) {
                closest = distance;
                closest_point = i;
            }
        }
        const double near = near_distance * lengths_[static_cast<std::size_t>(element)];
        if (closest < near * near) {
            add_near_element(layers, target, element, space_.xi[closest_point]);
            continue;
        }
        for (std::size_t i = first; i < first + per_element; ++i) layers.add(ring(samples_.curve[i]), densities_[i]);
    }
}

void MembraneSources::add_near_element(RingLayers& layers, const Target& target, Index element, double guess) const {
    const double begin = static_cast<double>(element) * space_.element_width();
    const auto [closest, p] = closest_on_element(space_, state_, element, target, guess);
    const double distance = std::max(std::sqrt(squared_distance(p, target)), least_distance);
    const OffsetRule rule =
        near_singular_rule(begin, begin + space_.element_width(), closest, distance / p.g, near_rule_);
    for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
        const double xi = rule.origin + rule.offsets[i];
        const BasisRow radial = space_.radial().basis(xi, element);
        const BasisRow axial = space_.axial().basis(xi, element);
        const CurvePoint x = curve_point(radial, axial, state_);
        layers.add(ring(x), density(x, radial, axial, space_.force().basis(xi), rule.weights[i]));
    }
}

}  // namespace endoflow::boundary_integral
