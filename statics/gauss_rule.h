#pragma once

#include <Eigen/Core>

namespace endoflow::statics {

/// Collocation at the k Gauss points of [0, 1]. On an element of width h, a function whose slope is the polynomial of
/// degree k−1 through the slopes K_l at the points has y(h ξ) = y(0) + h Σ_l integrals(ξ)_l K_l.
struct GaussRule {
    int points;
    Eigen::VectorXd nodes;         // ξ_j, (k)
    Eigen::VectorXd weights;       // b_l = ∫_0^1 L_l, (k)
    Eigen::MatrixXd stages;        // A_jl = ∫_0^{ξ_j} L_l, (k, k)
    Eigen::MatrixXd coefficients;  // L_l(ξ) = Σ_p coefficients(p, l) ξ^p, (k, k)

    /// k points, 1 ≤ k ≤ 8: order 2k at the ends of the elements for smooth problems, k + 1 between them.
    explicit GaussRule(int k);

    /// ∫_0^ξ L_l, (k).
    [[nodiscard]] Eigen::VectorXd integrals(double xi) const;
    /// L_l(ξ), (k).
    [[nodiscard]] Eigen::VectorXd values(double xi) const;
};

}  // namespace endoflow::statics
