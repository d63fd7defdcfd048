#include "boundary_integral/quadrature/singular_rules.h"

#include <algorithm>
#include <cmath>

namespace endoflow::boundary_integral {

OffsetRule near_singular_rule(double begin, double end, double closest, double width, const QuadratureRule& base) {
    OffsetRule rule;
    rule.origin = std::clamp(closest, begin, end);
    const auto side = [&](double low, double high) {       // offsets between low and high
        if (!(high - low > 1e-9 * (end - begin))) return;  // the point is this end, up to round-off
        const double eta_low = std::asinh(low / width);
        const double eta_high = std::asinh(high / width);
        const double middle = 0.5 * (eta_low + eta_high);
        const double half = 0.5 * (eta_high - eta_low);
        for (std::size_t i = 0; i < base.nodes.size(); ++i) {
            const double eta = middle + half * base.nodes[i];
            rule.offsets.push_back(width * std::sinh(eta));
            rule.weights.push_back(half * base.weights[i] * width * std::cosh(eta));
        }
    };
    side(begin - rule.origin, 0.0);
    side(0.0, end - rule.origin);
    return rule;
}

OffsetRule logarithmic_rule(double begin, double end, double closest, const QuadratureRule& base) {
    OffsetRule rule;
    rule.origin = std::clamp(closest, begin, end);
    const auto side = [&](double length) {
        if (std::abs(length) < 1e-9 * (end - begin)) return;  // the point is this end, up to round-off
        for (std::size_t i = 0; i < base.nodes.size(); ++i) {
            const double x = 0.5 * (1.0 + base.nodes[i]);
            rule.offsets.push_back(length * x * x * x);
            rule.weights.push_back(std::abs(length) * 1.5 * x * x * base.weights[i]);
        }
    };
    side(begin - rule.origin);
    side(end - rule.origin);
    return rule;
}

}  // namespace endoflow::boundary_integral
