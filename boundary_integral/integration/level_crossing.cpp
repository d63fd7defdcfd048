#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "boundary_integral/integration/stiff_integrator.h"

namespace endoflow::boundary_integral {

std::optional<double> falls_below(const StiffIntegrator& integrator,
                                  const std::function<double(const Eigen::VectorXd&)>& quantity, double level) {
    const auto excess = [&](double time) { return quantity(integrator.state_at(time)) - level; };
    double below = integrator.time(), above = below - integrator.last_step();
    double excess_below = quantity(integrator.state()) - level;
    if (excess_below > 0.0) return std::nullopt;
    double excess_above = excess(above);
    if (!(excess_above > 0.0)) return above;  // it fell below at the very end of the step before
    // Halves until both values are numbers; a quantity that is infinite down to the level has its jump bracketed.
    for (int i = 0; i < 60 && std::isinf(excess_above); ++i) {
        const double middle = 0.5 * (above + below), value = excess(middle);
        (value > 0.0 ? above : below) = middle;
        (value > 0.0 ? excess_above : excess_below) = value;
    }
    if (std::isinf(excess_above) || excess_below == 0.0) return below;
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(excess, above, below, excess_above, excess_below,
                                                           boost::math::tools::eps_tolerance<double>(50), iterations);
    return bracket.second;
}

}  // namespace endoflow::boundary_integral
