#include "boundary_integral/flow/membrane_collocation.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "boundary_integral/flow/dense_solver.h"

namespace endoflow::boundary_integral {

namespace {

Eigen::MatrixXd evaluation_rows(const MembraneSpace& space, Index rows) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, space.curve_count());
    Index row = 0;
    const auto add = [&](const SplineSpace& spline, double xi, Index offset) {
        const BasisRow basis = spline.basis(xi);
        for (std::size_t j = 0; j < static_cast<std::size_t>(basis.count); ++j) {
            matrix(row, offset + basis.index[j]) += basis.value[0][j];
        }
        ++row;
    };
    for (double xi : space.radial_targets) add(space.radial(), xi, 0);
    for (double xi : space.axial_targets) add(space.axial(), xi, space.radial_count());
    return matrix;
}

/// Of a matrix whose rows from `split` on have nothing left of it.
Eigen::MatrixXd triangular_inverse(const Eigen::MatrixXd& matrix, Index split, const char* what) {
    const Index rest = matrix.rows() - split;
    const Eigen::MatrixXd first = inverse(matrix.topLeftCorner(split, split), what);
    const Eigen::MatrixXd second = inverse(matrix.bottomRightCorner(rest, rest), what);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
    result.topLeftCorner(split, split) = first;
    result.topRightCorner(split, rest) = -first * (matrix.topRightCorner(split, rest) * second);
    result.bottomRightCorner(rest, rest) = second;
    return result;
}

}  // namespace

MembraneCollocation::MembraneCollocation(const MembraneSpace& space, const FluidParameters& fluid)
    : space_(space),
      viscosity_below_(fluid.viscosity_extracellular),
      viscosity_above_(fluid.viscosity_intracellular),
      evaluation_(evaluation_rows(space, rows())) {
    merge_targets();
    const QuadratureRule rule = gauss_legendre(LayerQuadrature{}.singular_points);
    for (Point& point : points_) point.own = own_elements(space_, membrane_functions(space_), point.xi, rule);
}

Index MembraneCollocation::rows() const {
    return static_cast<Index>(space_.radial_targets.size() + space_.axial_targets.size());
}

/// Both lists come from the same Greville points except at the ends: merge equal parameters.
void MembraneCollocation::merge_targets() {
    constexpr double slack = 1e-12;
    const auto& radial = space_.radial_targets;
    const auto& axial = space_.axial_targets;
    std::size_t i = 0, j = 0;
    while (i < radial.size() || j < axial.size()) {
        const double next_radial = i < radial.size() ? radial[i] : 2.0;
        const double next_axial = j < axial.size() ? axial[j] : 2.0;
        Point point{std::min(next_radial, next_axial), {}, {}};
        if (next_radial <= point.xi + slack) point.rows.radial = static_cast<Index>(i++);
        if (next_axial <= point.xi + slack) point.rows.axial = static_cast<Index>(radial.size() + j++);
        points_.push_back(std::move(point));
    }
}

std::vector<LayerTarget> MembraneCollocation::targets(const MembraneState& state) const {
    std::vector<LayerTarget> result;
    for (const Point& point : points_) {
        const CurvePoint p = curve_point(space_.radial().basis(point.xi), space_.axial().basis(point.xi), state);
        const bool on_axis = point.rows.radial < 0;
        result.push_back({{on_axis ? 0.0 : p.r, p.z}, point.rows, point.xi, -1, &point.own});
    }
    return result;
}

MembraneCollocation::Equation MembraneCollocation::equation(const MembraneState& state, const MembraneSamples& samples,
                                                            const std::vector<LayerTarget>& targets,
                                                            const LayerQuadrature& quadrature) const {
    const MembraneLayers layers = membrane_layers(space_, state, samples, targets, rows(), quadrature);
    return {4.0 * std::numbers::pi * (viscosity_below_ + viscosity_above_) * evaluation_ + contrast() * layers.doubled,
            layers.single};
}

void MembraneCollocation::solve(const Equation& equation, MobilityOperators& operators) const {
    const VelocityFreedoms& freedoms = operators.freedoms;
    const LuFactors velocity(freedoms.restrict_columns(equation.velocity), "velocity");
    operators.force_from_load = triangular_inverse(freedoms.restrict_rows(force_mass_matrix(space_, operators.samples)),
                                                   freedoms.radial(), "force mass");
    operators.mobility = velocity.solve(equation.force * operators.force_from_load);
}

}  // namespace endoflow::boundary_integral
