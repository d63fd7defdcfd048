#include "shared/numerics/gauss_legendre.h"

#include <boost/math/special_functions/legendre.hpp>

namespace endoflow {

QuadratureRule gauss_legendre(int count) {
    const std::vector<double> positive = boost::math::legendre_p_zeros<double>(count);  // the zeros >= 0, ascending
    QuadratureRule rule;
    const auto add = [&](double x) {
        const double slope = boost::math::legendre_p_prime(count, x);
        rule.nodes.push_back(x);
        rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
    };
    for (auto zero = positive.rbegin(); zero != positive.rend(); ++zero) add(-*zero);
    for (const double zero : positive)
        if (zero > 0) add(zero);
    return rule;
}

}  // namespace endoflow
