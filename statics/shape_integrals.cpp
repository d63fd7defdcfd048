#include "statics/shape_integrals.h"

#include <boost/math/quadrature/gauss.hpp>
#include <numbers>

namespace endoflow::statics {

namespace {

/// ∫ f(a, y(a)) da over the membrane, element by element.
template <class Function>
double integral(const PiecewiseSolution& solution, const GaussRule& rule, const Function& function) {
    const double label = solution.globals(global::area);
    const auto integrand = [&](double x) { return label * function(label * x, evaluate(solution, rule, x)); };
    double sum = 0;
    for (std::size_t i = 0; i < solution.elements(); ++i)
        sum += boost::math::quadrature::gauss<double, 10>::integrate(integrand, solution.mesh[i], solution.mesh[i + 1]);
    return sum;
}

}  // namespace

ShapeIntegrals shape_integrals(const StationaryCase& stationary, const PiecewiseSolution& solution,
                               const GaussRule& rule) {
    constexpr double two_pi = 2 * std::numbers::pi;
    const Loads loads = loads_of(stationary.parameters);
    const MembraneEnergy edge = line_energy(stationary.parameters);
    const double rim = stationary.parameters.domain.membrane_height;
    const auto over = [&](const auto& function) { return two_pi * integral(solution, rule, function); };
    const auto height_above_rim = [&](const auto& share) {
        return over([&](double a, const Eigen::VectorXd& y) { return (y(state::height) - rim) * share(a, y); });
    };
    const auto covered = [&](double a, const Eigen::VectorXd& y) { return point_of_shape(stationary, a, y).c; };
    const double coat = height_above_rim(covered) / over(covered);
    const double ring = height_above_rim([&](double a, const auto&) { return loads.ring_share(two_pi * a); });
    return {over([&](double a, const Eigen::VectorXd& y) { return point_of_shape(stationary, a, y).energy_density; }),
            two_pi * solution.globals(global::area),
            over([&](double, const Eigen::VectorXd& y) { return (y(state::height) - rim) * y(state::cosine); }),
            height_above_rim([&](double a, const auto&) { return loads.force_share(two_pi * a); }),
            over([&](double a, const Eigen::VectorXd& y) {
                const PointOfShape point = point_of_shape(stationary, a, y);
                return edge.density(point.total_curvature, point.c, point.squared_gradient).value;
            }),
            coat - ring,
            loads.radial() ? over([&](double a, const Eigen::VectorXd& y) {
                return std::sqrt(y(state::r_squared)) * loads.collar_share(two_pi * a);
            })
                           : 0.0};
}

}  // namespace endoflow::statics
