#include "boundary_integral/quadrature/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace endoflow::boundary_integral {

QuadratureRule gauss_legendre(int count) {
    QuadratureRule rule;
    rule.nodes.resize(static_cast<std::size_t>(count));
    rule.weights.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        // Newton iteration on P_n from Tricomi's estimate of its roots; the recurrence gives P_n and P_{n-1}.
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double derivative = 1.0;
        for (int iteration = 0; iteration < 12; ++iteration) {
            double previous = 1.0;
            double current = x;
            for (int n = 2; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * current - (n - 1) * previous) / n;
                previous = current;
                current = next;
            }
            if (count == 1) previous = 1.0;
            derivative = count * (x * current - previous) / (x * x - 1.0);
            const double correction = current / derivative;
            x -= correction;
            if (std::abs(correction) < 1e-16) break;
        }
        rule.nodes[static_cast<std::size_t>(i)] = x;
        rule.weights[static_cast<std::size_t>(i)] = 2.0 / ((1.0 - x * x) * derivative * derivative);
    }
    return rule;
}

}  // namespace endoflow::boundary_integral
