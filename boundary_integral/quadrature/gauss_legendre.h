#pragma once

#include <vector>

namespace endoflow::boundary_integral {

// Nodes in (-1, 1) and weights of the Gauss-Legendre rule with `count` points (exact for degree 2 count - 1).
struct QuadratureRule {
    std::vector<double> nodes;
    std::vector<double> weights;
};

QuadratureRule gauss_legendre(int count);

}  // namespace endoflow::boundary_integral
