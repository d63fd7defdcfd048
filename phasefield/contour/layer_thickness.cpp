#include "phasefield/contour/layer_thickness.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "phasefield/contour/closest_value.h"
#include "phasefield/layer/constants.h"
#include "shared/geometry/axisymmetric_spline.h"
#include "shared/model/time_scale.h"

namespace endoflow::phasefield {

namespace {

constexpr double thinnest = constant("thinnest");
constexpr double thinning_slope = constant("thinning_slope");
constexpr double thinning_window = constant("thinning_window");
constexpr double room_needed = constant("room_needed");

/// The curve by arc length, mirrored at the axis and straight beyond the rim. What lies behind the axis has negative r.
class ByArcLength {
  public:
    explicit ByArcLength(const MembraneCurve& curve) : s(chord_length(curve.r, curve.z)), curve_(&curve) {}

    [[nodiscard]] PlanePoint at(double along) const {
        const double distance = std::abs(along);
        if (curve_->closed() && distance > s.back()) {
            const PlanePoint mirrored = at(2 * s.back() - distance);
            return {-mirrored.r, mirrored.z};
        }
        const auto after = std::upper_bound(s.begin() + 1, s.end() - 1, distance);
        const auto i = static_cast<std::size_t>(after - s.begin());
        const double t = (distance - s[i - 1]) / (s[i] - s[i - 1]);
        const double r = curve_->r[i - 1] + t * (curve_->r[i] - curve_->r[i - 1]);
        return {along < 0 ? -r : r, curve_->z[i - 1] + t * (curve_->z[i] - curve_->z[i - 1])};
    }

    std::vector<double> s;  // [nm]

  private:
    const MembraneCurve* curve_;
};

double eighth_power(double x) {
    const double square = x * x, fourth = square * square;
    return fourth * fourth;
}

/// The mean over `half_width` [nm] of arc on either side, by the trapezoidal rule.
std::vector<double> averaged(const std::vector<double>& s, const std::vector<double>& values, double half_width) {
    std::vector<double> integral(s.size(), 0), out(s.size());
    for (std::size_t i = 1; i < s.size(); ++i)
        integral[i] = integral[i - 1] + 0.5 * (values[i] + values[i - 1]) * (s[i] - s[i - 1]);
    const auto up_to = [&](double along) {  // constant beyond the ends
        if (along <= 0) return values.front() * along;
        if (along >= s.back()) return integral.back() + values.back() * (along - s.back());
        const auto i = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), along) - s.begin());
        const double step = along - s[i - 1], slope = (values[i] - values[i - 1]) / (s[i] - s[i - 1]);
        return integral[i - 1] + step * (values[i - 1] + 0.5 * step * slope);
    };
    for (std::size_t i = 0; i < s.size(); ++i)
        out[i] = (up_to(s[i] + half_width) - up_to(s[i] - half_width)) / (2 * half_width);
    return out;
}

/// Three points of the curve, `window` [nm] of arc apart: what lies nearer may be noise, for the points of the contour
/// lie on many cells.
struct Chord {
    Chord(const ByArcLength& path, double s, double window)
        : before(path.at(s - window)), here(path.at(s)), after(path.at(s + window)) {}
    [[nodiscard]] double r() const { return after.r - before.r; }
    [[nodiscard]] double z() const { return after.z - before.z; }
    [[nodiscard]] double length() const { return std::hypot(r(), z()); }

    PlanePoint before, here, after;
};

/// The principal curvatures [1/nm].
std::array<double, 2> curvatures(const Chord& chord, double window) {
    const auto& [before, here, after] = chord;
    const double r1 = here.r - before.r, z1 = here.z - before.z, r2 = after.r - here.r, z2 = after.z - here.z;
    const double turn = std::atan2(r1 * z2 - z1 * r2, r1 * r2 + z1 * z2);
    const double along = turn / window;
    const double around = here.r > window ? chord.z() / (chord.length() * here.r) : along;
    return {along, around};
}

/// The radius to which a circle that touches the curve at s can grow, on either side, until it meets another part of
/// it [nm]: there the layers of the two would meet.
double room_of_layer(const MembraneCurve& curve, const ByArcLength& path, const Chord& chord, double s, double window) {
    const double length = chord.length();
    double least = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < curve.size(); ++j) {
        if (std::abs(path.s[j] - s) < 2 * window) continue;
        const double r = curve.r[j] - chord.here.r, z = curve.z[j] - chord.here.z;
        const double across = std::abs(chord.r() * z - chord.z() * r) / length;
        if (across > 0) least = std::min(least, (r * r + z * z) / (2 * across));
    }
    return least;
}

}  // namespace

double widest_layer(const Parameters& p, double r) {
    const double epsilon = p.phase_field.epsilon;
    const bool flat_far_away = p.domain.kind == DomainKind::box && p.molecules.exchange == Exchange::none;
    if (p.phase_field.production.thinning == 0 || !flat_far_away) return epsilon;
    const double near = p.molecules.patch_radius + std::numbers::pi * length_of_structure(p);
    const double to_wall = std::min(p.domain.membrane_height, p.domain.height - p.domain.membrane_height);
    const double flat_and_free = std::min(r - near, p.domain.radius - r);  // from coat and rim
    return std::max(epsilon, std::min(to_wall / room_needed, epsilon + thinning_slope * flat_and_free));
}

std::vector<double> thickness_along(const MembraneCurve& curve, const Parameters& p) {
    const double uniform = p.phase_field.epsilon, radius = p.phase_field.production.thinning * length_of_structure(p);
    std::vector<double> epsilon(curve.size(), uniform);
    if (radius == 0 || curve.size() < 3) return epsilon;
    const ByArcLength path(curve);
    const double window = thinning_window * uniform;
    for (std::size_t i = 0; i < epsilon.size(); ++i) {
        const Chord chord(path, path.s[i], window);
        const auto [along, around] = curvatures(chord, window);
        const double room = room_of_layer(curve, path, chord, path.s[i], window);
        const double widest = widest_layer(p, curve.r[i]);
        const double narrowing = 1 + eighth_power(radius * along) + eighth_power(radius * around) +
                                 eighth_power(room_needed * widest / room);
        epsilon[i] = widest * std::max(thinnest, std::pow(narrowing, -0.125));
    }
    const auto limit = [&](std::size_t i, std::size_t neighbour) {
        const double step = std::abs(path.s[i] - path.s[neighbour]);
        epsilon[i] = std::min(epsilon[i], epsilon[neighbour] + thinning_slope * step);
    };
    for (std::size_t i = 1; i < epsilon.size(); ++i) limit(i, i - 1);
    for (std::size_t i = epsilon.size() - 1; i > 0; --i) limit(i - 1, i);
    return averaged(path.s, averaged(path.s, epsilon, uniform), uniform);
}

ThicknessCurve::ThicknessCurve(const MembraneCurve& curve, double time, const Parameters& parameters)
    : r(curve.r), z(curve.z), epsilon(thickness_along(curve, parameters)) {
    if (curve.u_r.size() != curve.size()) return;  // at rest
    for (std::size_t i = 0; i < r.size(); ++i) {
        r[i] += time * curve.u_r[i];
        z[i] += time * curve.u_z[i];
    }
}

double ThicknessCurve::at(double at_r, double at_z) const {
    return ClosestValue(r, z, epsilon).at(at_r, at_z);
}

CellThickness::CellThickness(ThicknessCurve curve, const dealii::Triangulation<2>& mesh)
    : curve_(std::move(curve)), corners_(mesh.n_active_cells()) {
    const dealii::FE_Q<2> element(1);
    dealii::DoFHandler<2> dofs(mesh);
    dofs.distribute_dofs(element);
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    dealii::AffineConstraints<double> hanging(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dofs, hanging);
    hanging.close();
    dealii::Vector<double> values(dofs.n_dofs());  // of what this process sees
    const ClosestValue closest(curve_.r, curve_.z, curve_.epsilon);
    for (const auto& cell : dofs.active_cell_iterators())
        if (!cell->is_artificial())
            for (unsigned int v = 0; v < 4; ++v)
                values(cell->vertex_dof_index(v, 0)) = closest.at(cell->vertex(v)[0], cell->vertex(v)[1]);
    hanging.distribute(values);
    for (const auto& cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
            for (unsigned int v = 0; v < 4; ++v)
                corners_[cell->active_cell_index()][v] = values(cell->vertex_dof_index(v, 0));
}

PointThickness CellThickness::at(std::size_t active_cell, const CellBox& box, double x, double y) const {
    const auto& [a, b, c, d] = corners_[active_cell];
    const double lower = a + x * (b - a), upper = c + x * (d - c);
    return {lower + y * (upper - lower), ((1 - y) * (b - a) + y * (d - c)) / box.hr, (upper - lower) / box.hz};
}

std::shared_ptr<const CellThickness> thickness_on(const dealii::Triangulation<2>& mesh, ThicknessCurve curve) {
    return curve.r.empty() ? nullptr : std::make_shared<const CellThickness>(std::move(curve), mesh);
}

}  // namespace endoflow::phasefield
