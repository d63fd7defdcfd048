#pragma once

#include <cstddef>
#include <vector>

namespace endoflow {

/// What a polynomial's values at the nodes, all different, are multiplied with to give its value at x.
[[nodiscard]] inline std::vector<double> lagrange_weights(const std::vector<double>& nodes, double x) {
    std::vector<double> weights(nodes.size(), 1.0);
    for (std::size_t j = 0; j < nodes.size(); ++j)
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (k != j) weights[j] *= (x - nodes[k]) / (nodes[j] - nodes[k]);
    return weights;
}

}  // namespace endoflow
