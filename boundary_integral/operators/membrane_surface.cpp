#include "boundary_integral/operators/membrane_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary_integral/operators/closest_point.h"
#include "boundary_integral/operators/curve_offset.h"

namespace endoflow::boundary_integral {

namespace {

bool holds(const MembraneSpace& space, Index element, double xi) {
    constexpr double slack = 1e-12;
    const double begin = static_cast<double>(element) * space.element_width();
    return xi >= begin - slack && xi <= begin + space.element_width() + slack;
}

BasisTable table_of(const std::vector<BasisRow>& rows, std::size_t points_per_element) {
    BasisTable table(BasisRow::capacity, rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i % points_per_element == 0) table.begin_piece(rows[i].index);
        table.add(rows[i].value[0]);
    }
    return table;
}

ElementPoints element_points(const std::vector<MembraneFunctions>& functions, Index element, OffsetRule rule) {
    ElementPoints points{element, std::move(rule), {}};
    for (const auto& [splines, at_gauss_points] : functions) {
        // The last polynomial piece of f_z's splines is three elements long.
        const Index piece = std::min(element, static_cast<Index>(splines.breakpoints().size()) - 2);
        std::vector<BasisRow>& rows = points.rows.emplace_back();
        rows.reserve(points.rule.offsets.size());
        for (const double offset : points.rule.offsets)
            rows.push_back(splines.basis(points.rule.origin + offset, piece));
    }
    return points;
}

}  // namespace

std::vector<MembraneFunctions> membrane_functions(const MembraneSpace& space) {
    return {{space.radial(), space.radial_rows}, {space.axial(), space.axial_rows}, {space.force(), space.force_rows}};
}

std::vector<ElementPoints> own_elements(const MembraneSpace& space, const std::vector<MembraneFunctions>& functions,
                                        double xi, const QuadratureRule& base) {
    std::vector<ElementPoints> result;
    for (Index element = 0; element < space.elements(); ++element) {
        if (!holds(space, element, xi)) continue;
        const double begin = static_cast<double>(element) * space.element_width();
        const OffsetRule rule = logarithmic_rule(begin, begin + space.element_width(), xi, base);
        result.push_back(element_points(functions, element, rule));
    }
    return result;
}

MembraneSurface::MembraneSurface(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                                 std::vector<MembraneFunctions> functions, const LayerQuadrature& quadrature)
    : space_(space),
      state_(state),
      samples_(samples),
      functions_(std::move(functions)),
      singular_rule_(gauss_legendre(quadrature.singular_points)),
      near_rule_(gauss_legendre(quadrature.near_points)),
      near_distance_(quadrature.near_distance),
      lengths_(at(space.elements()), 0.0) {
    nodes_.pieces = space.elements();
    const std::size_t per_element = at(space.points_per_element());
    for (const MembraneFunctions& of_kind : functions_)
        nodes_.basis.push_back(table_of(of_kind.at_gauss_points, per_element));
    for (std::size_t i = 0; i < samples.curve.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        nodes_.add_node(p.r, p.z, p.normal_r, p.normal_z, space.weight[i] * p.r * p.g);
        lengths_[i / per_element] += space.weight[i] * p.g;
    }
}

/// offset_of(i, x): what point i, which lies at x, is from the target.
template <class OffsetOf>
SurfacePoints MembraneSurface::shown(const ElementPoints& on, const OffsetOf& offset_of) const {
    SurfacePoints points;
    for (std::size_t i = 0; i < on.rule.offsets.size(); ++i) {
        const CurvePoint x = curve_point(on.rows[0][i], on.rows[1][i], state_);
        const CurveOffset offset = offset_of(i, x);
        points.add(x.r, offset.r, offset.z, x.normal_r, offset.normal / x.g, on.rule.weights[i] * x.r * x.g);
    }
    for (const std::vector<BasisRow>& rows : on.rows) points.basis.push_back(table_of(rows, rows.size()));
    return points;
}

std::optional<SurfacePoints> MembraneSurface::points(const LayerTarget& target, Index element) const {
    if (!holds(space_, element, target.xi)) {
        const std::optional<ElementPoints> near = near_points(target.at, element);
        if (!near) return std::nullopt;
        return shown(*near, [&](std::size_t, const CurvePoint& x) {
            const double dr = x.r - target.at.r, dz = x.z - target.at.z;
            return CurveOffset{dr, dz, x.r1 * dz - x.z1 * dr};
        });
    }
    const std::vector<ElementPoints> made =
        target.own ? std::vector<ElementPoints>() : own_elements(space_, functions_, target.xi, singular_rule_);
    const std::vector<ElementPoints>& elements = target.own ? *target.own : made;
    const auto own = std::find_if(elements.begin(), elements.end(),
                                  [element](const ElementPoints& each) { return each.element == element; });
    // Differences from the Taylor polynomial about the target.
    const auto r = space_.radial().taylor(state_.r, own->rule.origin, element);
    const auto z = space_.axial().taylor(state_.z, own->rule.origin, element);
    return shown(*own, [&](std::size_t i, const CurvePoint&) { return curve_offset(r, z, own->rule.offsets[i]); });
}

std::optional<ElementPoints> MembraneSurface::near_points(const Target& target, Index element) const {
    const std::size_t first = at(element * space_.points_per_element());
    double closest = squared_distance(samples_.curve[first], target);
    std::size_t guess = first;
    for (std::size_t i = first + 1; i < first + at(space_.points_per_element()); ++i) {
        const double distance = squared_distance(samples_.curve[i], target);
        if (distance >= closest) continue;
        closest = distance;
        guess = i;
    }
    const double near = near_distance_ * length(element);
    if (closest >= near * near) return std::nullopt;
    return element_points(functions_, element,
                          near_element_rule(space_, state_, element, target, space_.xi[guess], near_rule_));
}

}  // namespace endoflow::boundary_integral
