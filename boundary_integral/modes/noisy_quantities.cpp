#include "boundary_integral/modes/noisy_quantities.h"

#include <cmath>
#include <functional>

#include "boundary_integral/modes/perturbations.h"

namespace endoflow::boundary_integral {

NoisyQuantity pole_height(const Surroundings& surroundings, const BaseState& base) {
    const BasePoint pole = base_point(surroundings.membrane(), base, surroundings.viscosities(), 0.0);
    return {0, pole.curve.normal_z * displacement_values(surroundings.space(0), {0.0})};
}

BudQuantities bud_quantities(const Surroundings& surroundings, const BaseState& base, const Neck& neck) {
    const MeridianPoints bud = points_before(surroundings.membrane(), base.membrane, neck.t);
    // Integrals over the meridian of a function of its points.
    const auto weights = [&](const std::function<double(const CurvePoint&)>& function) {
        Eigen::RowVectorXd values(static_cast<Index>(bud.xi.size()));
        for (std::size_t i = 0; i < bud.xi.size(); ++i)
            values[static_cast<Index>(i)] = bud.weight[i] * function(bud.curve[i]);
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
