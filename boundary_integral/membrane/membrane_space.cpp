#include "boundary_integral/membrane/membrane_space.h"

#include <cmath>

namespace endoflow::boundary_integral {

namespace {

constexpr int curve_degree = 5;

std::vector<double> without_last_two_inner(Index elements) {
    std::vector<double> points = uniform_breakpoints(elements);
    points.erase(points.end() - 3, points.end() - 1);
    return points;
}

RightEnd right_end(CurveEnd end) {
    return end == CurveEnd::clamped ? RightEnd::free : RightEnd::mirrored;
}

}  // namespace

MembraneSpace::MembraneSpace(Index elements, int gauss_points, CurveEnd end)
    : end_(end),
      elements_(elements),
      points_per_element_(gauss_points),
      radial_(curve_degree, uniform_breakpoints(elements), Parity::odd, right_end(end)),
      axial_(curve_degree, uniform_breakpoints(elements), Parity::even, right_end(end)),
      force_(curve_degree, end == CurveEnd::clamped ? without_last_two_inner(elements) : uniform_breakpoints(elements),
             Parity::even, right_end(end)),
      tension_(curve_degree - 1, uniform_breakpoints(elements), Parity::even, right_end(end)) {
    const QuadratureRule rule = gauss_legendre(gauss_points);
    const double width = element_width();
    for (Index e = 0; e < elements; ++e) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double point = (static_cast<double>(e) + 0.5 * (1.0 + rule.nodes[i])) * width;
            xi.push_back(point);
            weight.push_back(0.5 * width * rule.weights[i]);
            radial_rows.push_back(radial_.basis(point, e));
            axial_rows.push_back(axial_.basis(point, e));
            force_rows.push_back(force_.basis(point));
            tension_rows.push_back(tension_.basis(point, e));
        }
    }
    radial_targets = radial_.greville_points();
    axial_targets = axial_.greville_points();
    if (end_ == CurveEnd::closed) return;
    // u_r = 0 on the axis by parity, and the rim itself is an edge of both fluids: stay a twentieth of an element away
    // from it.
    radial_targets.back() = 1.0 - 0.05 * width;
    // Height and slope are prescribed at the rim: the two last axial equations give way to them.
    axial_targets.resize(axial_targets.size() - 2);
}

CurvePoint curve_point(const BasisRow& radial, const BasisRow& axial, const MembraneState& state) {
    CurvePoint p{};
    p.r = radial.evaluate(state.r, 0);
    p.r1 = radial.evaluate(state.r, 1);
    p.r2 = radial.evaluate(state.r, 2);
    p.z = axial.evaluate(state.z, 0);
    p.z1 = axial.evaluate(state.z, 1);
    p.z2 = axial.evaluate(state.z, 2);
    p.g = std::sqrt(p.r1 * p.r1 + p.z1 * p.z1);
    p.normal_r = -p.z1 / p.g;
    p.normal_z = p.r1 / p.g;
    p.meridional_curvature = -(p.r1 * p.z2 - p.z1 * p.r2) / (p.g * p.g * p.g);
    p.azimuthal_curvature = p.on_axis() ? p.meridional_curvature : -p.z1 / (p.r * p.g);
    return p;
}

MembraneSamples sample(const MembraneSpace& space, const MembraneState& state) {
    MembraneSamples samples;
    const auto count = static_cast<std::size_t>(space.points());
    samples.curve.resize(count);
    for (auto* values : {&samples.c, &samples.c1, &samples.c2}) values->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        samples.curve[i] = curve_point(space.radial_rows[i], space.axial_rows[i], state);
        samples.c[i] = space.axial_rows[i].evaluate(state.c, 0);
        samples.c1[i] = space.axial_rows[i].evaluate(state.c, 1);
        samples.c2[i] = space.axial_rows[i].evaluate(state.c, 2);
    }
    samples.rim_radius = space.end() == CurveEnd::clamped ? space.radial().basis(1.0).evaluate(state.r, 0) : 0.0;
    return samples;
}

MeridianPoints points_before(const MembraneSpace& space, const MembraneState& state, double xi) {
    const QuadratureRule rule = gauss_legendre(static_cast<int>(space.points_per_element()));
    MeridianPoints result;
    for (Index element = 0; element < space.elements(); ++element) {
        const double begin = static_cast<double>(element) * space.element_width();
        const double half = 0.5 * (std::min(begin + space.element_width(), xi) - begin);
        if (half <= 0.0) break;
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double at = begin + half * (1.0 + rule.nodes[q]);
            result.xi.push_back(at);
            result.weight.push_back(half * rule.weights[q]);
            result.curve.push_back(
                curve_point(space.radial().basis(at, element), space.axial().basis(at, element), state));
        }
    }
    return result;
}

}  // namespace endoflow::boundary_integral
