#include "boundary_integral/operators/closest_point.h"

#include <algorithm>
#include <cmath>

namespace endoflow::boundary_integral {

namespace {

/// In lengths of an element: from here on the closest Gauss point serves as the closest point.
constexpr double far = 2.0;

}  // namespace

double squared_distance(const CurvePoint& p, const Target& target) {
    const double dr = p.r - target.r;
    const double dz = p.z - target.z;
    return dr * dr + dz * dz;
}

ClosestPoint closest_on_element(const MembraneSpace& space, const MembraneState& state, Index element,
                                const Target& target, double guess) {
    const double begin = static_cast<double>(element) * space.element_width();
    const double end = begin + space.element_width();
    double closest = guess;
    CurvePoint p{};
    for (int iteration = 0; iteration < 6; ++iteration) {  // Newton for (x - x0).x' = 0
        p = curve_point(space.radial().basis(closest, element), space.axial().basis(closest, element), state);
        const double dr = p.r - target.r;
        const double dz = p.z - target.z;
        const double slope = std::max(p.g * p.g + dr * p.r2 + dz * p.z2, 0.2 * p.g * p.g);
        const double next = std::clamp(closest - (dr * p.r1 + dz * p.z1) / slope, begin, end);
        if (std::abs(next - closest) < 1e-10) break;
        closest = next;
    }
    return {closest, p};
}

OffsetRule near_element_rule(const MembraneSpace& space, const MembraneState& state, Index element,
                             const Target& target, double guess, const QuadratureRule& base) {
    constexpr double smallest_distance = 1e-14;  // nm
    const double begin = static_cast<double>(element) * space.element_width();
    const auto [closest, p] = closest_on_element(space, state, element, target, guess);
    const double distance = std::max(std::sqrt(squared_distance(p, target)), smallest_distance);
    return near_singular_rule(begin, begin + space.element_width(), closest, distance / p.g, base);
}

ClosestPoint closest_on_membrane(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                                 const Target& target) {
    std::size_t nearest = 0;
    double smallest = squared_distance(samples.curve[0], target);
    for (std::size_t i = 1; i < samples.curve.size(); ++i) {
        const double distance = squared_distance(samples.curve[i], target);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = i;
    }
    const Index own = static_cast<Index>(nearest) / space.points_per_element();
    // Gauss points of neighbours are nearer to each other than an element is long.
    const double length = samples.curve[nearest].g * space.element_width();
    if (smallest > far * far * length * length) return {space.xi[nearest], samples.curve[nearest]};
    ClosestPoint best = closest_on_element(space, state, own, target, space.xi[nearest]);
    // Between the last Gauss points of two elements either may hold it.
    for (const Index element : {own - 1, own + 1}) {
        if (element < 0 || element >= space.elements()) continue;
        const double shared_end = static_cast<double>(std::max(own, element)) * space.element_width();
        const ClosestPoint other = closest_on_element(space, state, element, target, shared_end);
        if (squared_distance(other.point, target) < squared_distance(best.point, target)) best = other;
    }
    return best;
}

}  // namespace endoflow::boundary_integral
