#include "boundary_integral/modes/noisy_quantities.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "boundary_integral/modes/perturbations.h"

namespace endoflow::boundary_integral {

namespace {

// Gauss points of the meridian between the pole and xi_end, which cuts an element.
struct BudPoints {
    std::vector<double> xi;
    Eigen::VectorXd weight;
    std::vector<CurvePoint> curve;
};

BudPoints bud_points(const MembraneSpace& space, const MembraneState& state, double xi_end) {
    const QuadratureRule rule = gauss_legendre(8);
    std::vector<double> weights;
    BudPoints result;
    for (Index e = 0; e < space.elements(); ++e) {
        const double begin = static_cast<double>(e) * space.element_width();
        const double half = 0.5 * (std::min(begin + space.element_width(), xi_end) - begin);
        if (half <= 0.0) break;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double xi = begin + half * (1.0 + rule.nodes[i]);
            result.xi.push_back(xi);
            weights.push_back(half * rule.weights[i]);
            result.curve.push_back(curve_point(space.radial().basis(xi, e), space.axial().basis(xi, e), state));
        }
    }
    result.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Index>(weights.size()));
    return result;
}

}  // namespace

NoisyQuantity pole_height(const Surroundings& surroundings, const BaseState& base) {
    const BasePoint pole = base_point(surroundings.membrane(), base, surroundings.viscosities(), 0.0);
    return {0, pole.curve.normal_z * displacement_values(surroundings.space(0), {0.0})};
}

BudQuantities bud_quantities(const Surroundings& surroundings, const BaseState& base, const Neck& neck) {
    const BudPoints bud = bud_points(surroundings.membrane(), base.membrane, neck.t);
    // Integrals over the meridian of a function of its points.
    const auto weights = [&](const std::function<double(const CurvePoint&)>& function) {
        Eigen::RowVectorXd values(bud.weight.size());
        for (Index i = 0; i < values.size(); ++i) {
            values[i] = bud.weight[i] * function(bud.curve[static_cast<std::size_t>(i)]);
        }
        return values;
    };
    // x = r cos phi, dV = w cos(m phi) dA on the displaced surface; int cos^2 = pi is left out on both sides.
    const double volume = std::abs(weights([](const CurvePoint& p) { return p.r * p.r * p.z1; }).sum());
    const double moment = std::abs(weights([](const CurvePoint& p) { return 0.5 * std::pow(p.r, 4) * p.z1; }).sum());
    const Eigen::RowVectorXd first = weights([](const CurvePoint& p) { return p.r * p.r * p.g; });
    const Eigen::RowVectorXd second = weights([](const CurvePoint& p) { return p.r * p.r * p.r * p.g; });
    const double normal_r =
        base_point(surroundings.membrane(), base, surroundings.viscosities(), neck.t).curve.normal_r;
    const auto at_neck = [&](int mode, double factor) {
        return NoisyQuantity{mode, factor * normal_r * displacement_values(surroundings.space(mode), {neck.t})};
    };
    return {at_neck(0, 1.0),
            {1, first * displacement_values(surroundings.space(1), bud.xi) / volume},
            {2, second * displacement_values(surroundings.space(2), bud.xi) / (2.0 * moment)},
            at_neck(2, 1.0 / neck.radius)};
}

}  // namespace endoflow::boundary_integral
