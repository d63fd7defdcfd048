#pragma once

#include <vector>

namespace endoflow {

/// Nodes in (−1, 1), ascending, and weights of a rule for ∫ over (−1, 1).
struct QuadratureRule {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// The Gauss–Legendre rule with `count` points, exact to degree 2 count − 1, for counts known at run time only.
[[nodiscard]] QuadratureRule gauss_legendre(int count);

}  // namespace endoflow
