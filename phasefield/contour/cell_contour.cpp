#include "phasefield/contour/cell_contour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "phasefield/fem/same_cell.h"
#include "phasefield/layer/profile.h"
#include "shared/numerics/root.h"

namespace endoflow::phasefield {

namespace {

double value_at(const dealii::FE_Q<2>& element, const std::vector<double>& coefficients, const dealii::Point<2>& x) {
    double sum = 0;
    for (unsigned int i = 0; i < coefficients.size(); ++i) sum += coefficients[i] * element.shape_value(i, x);
    return sum;
}

}  // namespace

CellContour::CellContour(const ContourFields& fields, unsigned int subdivisions)
    : fields_(fields),
      subdivisions_(subdivisions),
      phi_element_(fields.flow_space->degrees[fields.level_set]),
      velocity_element_(fields.flow_space->degrees[fields.velocity_r]),
      tension_element_(fields.flow_space->degrees[fields.tension]),
      molecule_element_(fields.molecule_space->degrees[fields.concentration]),
      flow_values_(fields.flow_space->element.n_dofs_per_cell()),
      molecule_values_(fields.molecule_space->element.n_dofs_per_cell()) {
    for (unsigned int k = 0; k <= subdivisions; ++k)
        for (unsigned int i = 0; i <= subdivisions; ++i) {
            const dealii::Point<2> x(double(i) / subdivisions, double(k) / subdivisions);
            auto& shapes = lattice_shapes_.emplace_back();
            for (unsigned int j = 0; j < phi_element_.n_dofs_per_cell(); ++j)
                shapes.push_back(phi_element_.shape_value(j, x));
        }
}

double CellContour::phi_at(double x, double y) const {
    return value_at(phi_element_, phi_, {x, y});
}

ContourPoint CellContour::point(double x, double y) const {
    const dealii::Point<2> unit(x, y);
    LevelSetPoint p;
    for (unsigned int j = 0; j < phi_.size(); ++j) {
        const auto gradient = phi_element_.shape_grad(j, unit);
        const auto hessian = phi_element_.shape_grad_grad(j, unit);
        p.r += phi_[j] * gradient[0] / box_.hr;
        p.z += phi_[j] * gradient[1] / box_.hz;
        p.rr += phi_[j] * hessian[0][0] / (box_.hr * box_.hr);
        p.rz += phi_[j] * hessian[0][1] / (box_.hr * box_.hz);
        p.zz += phi_[j] * hessian[1][1] / (box_.hz * box_.hz);
    }
    const double gradient = std::max(std::hypot(p.r, p.z), std::numeric_limits<double>::min());
    const double r = box_.r0 + x * box_.hr, c = value_at(molecule_element_, c_, unit);
    return {r,
            box_.z0 + y * box_.hz,
            c,
            fields_.tension_factor * value_at(tension_element_, lambda_, unit),
            -normal_divergence(p, r, 0),
            value_at(velocity_element_, u_r_, unit),
            value_at(velocity_element_, u_z_, unit),
            p.r / gradient,
            p.z / gradient};
}

ContourPoint CellContour::root(Corner a, Corner b) const {
    if (a.x > b.x || a.y > b.y) std::swap(a, b);  // the neighbour shall find the same root
    const auto along = [&](double t) { return phi_at(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)); };
    const double f_a = along(0), f_b = along(1);
    double t = std::abs(f_a) < std::abs(f_b) ? 0 : 1;             // where round-off hides the change of sign
    const auto shifted = [&](double x) { return along(x - 1); };  // 46 bits of 1 … 2 are an absolute error
    if (f_a * f_b < 0) t = root_between(shifted, 1.0, 2.0, f_a, f_b, 46) - 1;
    return point(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
}

std::vector<CellContour::Corner> CellContour::corners(unsigned int i, unsigned int k) const {
    const unsigned int n = subdivisions_;
    const auto lattice_point = [&](unsigned int a, unsigned int b) {
        return Corner{double(a) / n, double(b) / n, lattice_[b * (n + 1) + a] >= 0};
    };
    const Corner square[4] = {lattice_point(i, k), lattice_point(i + 1, k), lattice_point(i + 1, k + 1),
                              lattice_point(i, k + 1)};
    const bool halved[4] = {k == 0 && finer_beyond_[2], i + 1 == n && finer_beyond_[1], k + 1 == n && finer_beyond_[3],
                            i == 0 && finer_beyond_[0]};
    std::vector<Corner> out;
    for (unsigned int e = 0; e < 4; ++e) {
        out.push_back(square[e]);
        const Corner& next = square[(e + 1) % 4];
        const double x = 0.5 * (square[e].x + next.x), y = 0.5 * (square[e].y + next.y);
        if (halved[e]) out.push_back({x, y, phi_at(x, y) >= 0});
    }
    return out;
}

void CellContour::add_square(unsigned int i, unsigned int k, std::vector<ContourSegment>& segments) const {
    const auto around = corners(i, k);
    std::vector<ContourPoint> roots;
    bool after_first = false;  // sign between the first root and the second
    for (std::size_t e = 0; e < around.size(); ++e) {
        const Corner &a = around[e], &b = around[(e + 1) % around.size()];
        if (a.positive == b.positive) continue;
        if (roots.empty()) after_first = b.positive;
        roots.push_back(root(a, b));
    }
    if (roots.size() == 2) segments.push_back({roots[0], roots[1]});
    if (roots.size() < 4) return;
    // The value in the middle decides which stretches of the boundary belong together: those of the other sign are cut
    // off.
    const bool middle = phi_at((i + 0.5) / subdivisions_, (k + 0.5) / subdivisions_) >= 0;
    for (std::size_t first = middle == after_first ? 1 : 0; first < roots.size(); first += 2)
        segments.push_back({roots[first], roots[(first + 1) % roots.size()]});
}

void CellContour::add_segments(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell,
                               std::vector<ContourSegment>& segments) {
    flow_cell->get_dof_values(*fields_.flow, flow_values_);
    component_values(*fields_.flow_space, fields_.level_set, flow_values_, phi_);
    lattice_.resize(lattice_shapes_.size());
    bool any_positive = false, any_negative = false;
    for (std::size_t point = 0; point < lattice_.size(); ++point) {
        lattice_[point] = 0;
        for (std::size_t j = 0; j < phi_.size(); ++j) lattice_[point] += lattice_shapes_[point][j] * phi_[j];
        (lattice_[point] >= 0 ? any_positive : any_negative) = true;
    }
    for (unsigned int face = 0; face < 4; ++face) finer_beyond_[face] = flow_cell->face(face)->has_children();
    const bool finer_beyond = std::ranges::count(finer_beyond_, true) > 0;
    if (!finer_beyond && (!any_positive || !any_negative)) return;

    box_ = cell_box(flow_cell);
    same_cell(flow_cell, *fields_.molecule_space)->get_dof_values(*fields_.molecules, molecule_values_);
    component_values(*fields_.flow_space, fields_.velocity_r, flow_values_, u_r_);
    component_values(*fields_.flow_space, fields_.velocity_z, flow_values_, u_z_);
    component_values(*fields_.flow_space, fields_.tension, flow_values_, lambda_);
    component_values(*fields_.molecule_space, fields_.concentration, molecule_values_, c_);
    for (unsigned int k = 0; k < subdivisions_; ++k)
        for (unsigned int i = 0; i < subdivisions_; ++i) add_square(i, k, segments);
}

}  // namespace endoflow::phasefield
