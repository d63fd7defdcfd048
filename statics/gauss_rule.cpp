#include "statics/gauss_rule.h"

#include <Eigen/LU>
#include <boost/math/special_functions/legendre.hpp>
#include <stdexcept>
#include <vector>

namespace endoflow::statics {

namespace {

/// Roots of the Legendre polynomial of degree k, mapped to [0, 1] and ascending.
Eigen::VectorXd gauss_nodes(int k) {
    const std::vector<double> half = boost::math::legendre_p_zeros<double>(k);  // the roots ≥ 0
    Eigen::VectorXd nodes(k);
    for (int i = 0; i < static_cast<int>(half.size()); ++i) {
        const double root = half[half.size() - 1 - static_cast<std::size_t>(i)];
        nodes(i) = 0.5 * (1 - root);
        nodes(k - 1 - i) = 0.5 * (1 + root);
    }
    return nodes;
}

}  // namespace

GaussRule::GaussRule(int k) : points(k) {
    if (k < 1 || k > 8) throw std::invalid_argument("GaussRule: 1 to 8 points");
    nodes = gauss_nodes(k);
    Eigen::MatrixXd vandermonde(k, k);  // row l: powers of ξ_l
    for (int p = 0; p < k; ++p) vandermonde.col(p) = nodes.array().pow(p);
    coefficients = vandermonde.inverse();
    weights = integrals(1);
    stages.resize(k, k);
    for (int j = 0; j < k; ++j) stages.row(j) = integrals(nodes(j)).transpose();
}

Eigen::VectorXd GaussRule::integrals(double xi) const {
    Eigen::VectorXd powers(points);
    double power = 1;
    for (int p = 0; p < points; ++p) powers(p) = (power *= xi) / (p + 1);
    return coefficients.transpose() * powers;
}

Eigen::VectorXd GaussRule::values(double xi) const {
    Eigen::VectorXd powers(points);
    double power = 1;
    for (int p = 0; p < points; ++p, power *= xi) powers(p) = power;
    return coefficients.transpose() * powers;
}

}  // namespace endoflow::statics
