#include "boundary_integral/membrane/external_loads.h"

#include <numbers>

#include "boundary_integral/membrane/energy.h"
#include "shared/numerics/gauss_legendre.h"
#include "shared/numerics/lagrange.h"

namespace endoflow::boundary_integral {

namespace {

using LabelJet = Jet<1>;

/// Integrals over the interpolation polynomials from -1 to the nodes: (i, j) = ∫_{-1}^{x_i} L_j.
Eigen::MatrixXd partial_integrals(const QuadratureRule& rule) {
    const auto count = static_cast<Index>(rule.nodes.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double half = 0.5 * (rule.nodes[i] + 1.0);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const std::vector<double> at = lagrange_weights(rule.nodes, -1.0 + half * (1.0 + rule.nodes[q]));
            result.row(static_cast<Index>(i)) += half * rule.weights[q] * Eigen::RowVectorXd::Map(at.data(), count);
        }
    }
    return result;
}

/// ∫_0^ξ of functions given by their values at the Gauss points, at these points; a column is a function.
Eigen::MatrixXd running_integral(const MembraneSpace& space, const Eigen::MatrixXd& values) {
    const Index q = space.points_per_element();
    const Eigen::MatrixXd within = 0.5 * space.element_width() * partial_integrals(gauss_legendre(static_cast<int>(q)));
    Eigen::MatrixXd result(values.rows(), values.cols());
    Eigen::RowVectorXd before = Eigen::RowVectorXd::Zero(values.cols());
    for (Index first = 0; first < values.rows(); first += q) {
        result.middleRows(first, q) = (within * values.middleRows(first, q)).rowwise() + before;
        for (Index i = first; i < first + q; ++i) before += space.weight[static_cast<std::size_t>(i)] * values.row(i);
    }
    return result;
}

/// The pole force's part per area at the Gauss points [1/nm²] and its derivative by the area from the pole.
std::vector<LabelJet> force_shares(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    Eigen::VectorXd density(space.points());
    for (Index i = 0; i < space.points(); ++i) {
        const CurvePoint& p = samples.curve[static_cast<std::size_t>(i)];
        density[i] = 2.0 * std::numbers::pi * p.r * p.g;
    }
    const Eigen::MatrixXd area = running_integral(space, density);
    std::vector<LabelJet> shares;
    for (Index i = 0; i < space.points(); ++i) shares.push_back(loads.force_share(LabelJet::variable(area(i, 0), 0)));
    return shares;
}

}  // namespace

Eigen::VectorXd external_load(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(space.curve_count());
    if (loads.none()) return load;
    if (loads.pressure != 0.0) load += loads.pressure * volume_gradient(space, samples).transpose();
    if (loads.pole_force != 0.0) {
        const std::vector<LabelJet> shares = force_shares(space, samples, loads);
        for (std::size_t i = 0; i < space.xi.size(); ++i) {
            const CurvePoint& p = samples.curve[i];
            const BasisRow& axial = space.axial_rows[i];
            const double force = loads.pole_force * space.weight[i] * p.r * p.g * shares[i].value;
            for (std::size_t j = 0; j < 6; ++j)
                load[space.radial_count() + axial.index[j]] += force * axial.value[0][j];
        }
    }
    load[space.radial_count() - 1] += loads.rim_tension * samples.rim_radius;
    return load;
}

Eigen::MatrixXd pole_force_variation(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    const Index offset = space.radial_count();
    Eigen::MatrixXd density = Eigen::MatrixXd::Zero(space.points(), space.curve_count());  // variation of r g
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow &radial = space.radial_rows[i], &axial = space.axial_rows[i];
        const auto row = static_cast<Index>(i);
        for (std::size_t j = 0; j < 6; ++j) {
            density(row, radial.index[j]) += p.g * radial.value[0][j] + p.r * p.r1 / p.g * radial.value[1][j];
            density(row, offset + axial.index[j]) += p.r * p.z1 / p.g * axial.value[1][j];
        }
    }
    const Eigen::MatrixXd area = 2.0 * std::numbers::pi * running_integral(space, density);
    const std::vector<LabelJet> shares = force_shares(space, samples, loads);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(space.curve_count(), space.curve_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow& axial = space.axial_rows[i];
        const auto row = static_cast<Index>(i);
        const Eigen::RowVectorXd change =
            loads.pole_force * space.weight[i] *
            (shares[i].value * density.row(row) + shares[i].partial[0] * p.r * p.g * area.row(row));
        for (std::size_t j = 0; j < 6; ++j) result.row(offset + axial.index[j]) += axial.value[0][j] * change;
    }
    return result;
}

}  // namespace endoflow::boundary_integral
