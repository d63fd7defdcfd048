#include "boundary_integral/modes/mode_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace endoflow::boundary_integral {

namespace {

// Functions of a space that do not vanish with all their derivatives at a mirror.
Index functions_at_mirror(const SplineSpace& splines, bool odd) {
    return odd ? splines.degree() / 2 : (splines.degree() + 1) / 2;
}

// Combinations of the functions first ... first + count - 1 whose continuous derivatives of the right parity below
// `order` vanish at xi.
Eigen::MatrixXd vanishing(const SplineSpace& splines, double xi, Index first, Index count, int order, int parity) {
    std::vector<int> derivatives;
    for (int d = parity; d < std::min(order, splines.degree()); d += 2) derivatives.push_back(d);
    if (derivatives.empty()) return Eigen::MatrixXd::Identity(count, count);
    const auto rows = static_cast<Index>(derivatives.size());
    if (rows >= count) return Eigen::MatrixXd(count, 0);
    Eigen::MatrixXd conditions(rows, count);
    for (Index j = 0; j < count; ++j) {
        const auto values =
            splines.taylor(Eigen::VectorXd::Unit(splines.dimension(), first + j), xi, splines.element_of(xi));
        for (Index i = 0; i < rows; ++i) {
            conditions(i, j) = values[static_cast<std::size_t>(derivatives[static_cast<std::size_t>(i)])];
        }
    }
    for (Index i = 0; i < rows; ++i) conditions.row(i) /= conditions.row(i).cwiseAbs().maxCoeff();
    return Eigen::FullPivLU<Eigen::MatrixXd>(conditions).kernel();
}

SplineSpace with_parity(const SplineSpace& like, Parity parity, CurveEnd end) {
    return {like.degree(), like.breakpoints(), parity, end == CurveEnd::closed ? RightEnd::mirrored : RightEnd::free};
}

std::array<SplineSpace, 2> both(const SplineSpace& like, CurveEnd end) {
    return {with_parity(like, Parity::even, end), with_parity(like, Parity::odd, end)};
}

std::size_t parity_of(int mode) {
    return static_cast<std::size_t>(mode % 2);
}

std::vector<VelocityComponent> components_of(int mode, const SplineSpace& lateral, const SplineSpace& vertical,
                                             CurveEnd end) {
    std::vector<VelocityComponent> result;
    if (mode == 0) {
        result.push_back({AxisSplines(lateral, 1, end), 1.0, 0.0, 0.0});
    } else {
        result.push_back({AxisSplines(lateral, mode - 1, end), 0.5, -0.5, 0.0});  // v_r - v_phi
        result.push_back({AxisSplines(lateral, mode + 1, end), 0.5, 0.5, 0.0});   // v_r + v_phi
    }
    result.push_back({AxisSplines(vertical, mode, end), 0.0, 0.0, 1.0});
    return result;
}

Eigen::MatrixXd physical(const std::vector<VelocityComponent>& components, Index lateral, Index vertical) {
    Index count = 0;
    for (const VelocityComponent& c : components) count += c.splines.dimension();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * lateral + vertical, count);
    Index column = 0;
    for (const VelocityComponent& c : components) {
        const Eigen::MatrixXd& expansion = c.splines.expansion();
        const auto add = [&](Index row, double factor) {
            if (factor != 0.0) matrix.block(row, column, expansion.rows(), expansion.cols()) = factor * expansion;
        };
        add(0, c.radial);
        add(lateral, c.azimuthal);
        add(2 * lateral, c.axial);
        column += expansion.cols();
    }
    return matrix;
}

}  // namespace

AxisSplines::AxisSplines(SplineSpace splines, int order, CurveEnd end) : splines_(std::move(splines)) {
    const Index n = splines_.dimension();
    const int parity = order % 2;
    const Index local = functions_at_mirror(splines_, parity == 1);
    const Eigen::MatrixXd start = vanishing(splines_, 0.0, 0, local, order, parity);
    const Index dropped = local - start.cols();
    const bool closed = end == CurveEnd::closed;
    const Eigen::MatrixXd stop =
        closed ? vanishing(splines_, 1.0, n - local, local, order, parity) : Eigen::MatrixXd::Identity(local, local);
    expansion_ = Eigen::MatrixXd::Zero(n, n - dropped - (local - stop.cols()));
    expansion_.topLeftCorner(local, start.cols()) = start;
    expansion_.block(local, start.cols(), n - 2 * local, n - 2 * local).setIdentity();
    expansion_.bottomRightCorner(local, stop.cols()) = stop;
    points_ = splines_.greville_points();
    points_.erase(points_.begin(), points_.begin() + dropped);
    points_.resize(static_cast<std::size_t>(expansion_.cols()));
}

ParitySpaces::ParitySpaces(const MembraneSpace& space)
    : end(space.end()),
      quintic(both(space.axial(), end)),
      force(both(space.force(), end)),
      tension(both(space.tension(), end)) {}

ModeSpace::ModeSpace(const MembraneSpace& membrane, const ParitySpaces& spaces, int mode)
    : membrane_(membrane),
      spaces_(spaces),
      mode_(mode),
      parity_(parity_of(mode)),
      scalar_(vertical(), mode, spaces.end),
      tension_(spaces.tension[parity_], mode, spaces.end),
      components_(components_of(mode, lateral(), vertical(), spaces.end)) {
    const auto of_force = components_of(mode, lateral(), vertical_force(), spaces.end);
    forces_ = physical(of_force, lateral().dimension(), vertical_force().dimension());
    velocities_ = physical(components_, lateral().dimension(), vertical().dimension());
    for (const VelocityComponent& component : components_) targets_.push_back(component.splines.points());
    if (!clamped()) return;
    // As for the axisymmetric flow: a twentieth of an element away from the rim, and the two last axial equations give
    // way to height and slope.
    for (auto& points : targets_) points.back() = 1.0 - 0.05 * membrane.element_width();
    targets_.back().resize(targets_.back().size() - 2);
    velocities_ = Eigen::MatrixXd(velocities_.leftCols(velocities_.cols() - 2));
}

}  // namespace endoflow::boundary_integral
