#include "statics/vesicle_equations.h"

#include <cmath>
#include <numbers>

#include "statics/dual_system.h"

namespace endoflow::statics {

namespace {

using std::numbers::pi;
constexpr std::size_t vesicle_unknowns = static_cast<std::size_t>(vesicle::states) + 1;
using VesicleNumber = Dual<vesicle_unknowns>;

struct VesicleVariables {
    std::array<VesicleNumber, vesicle_unknowns> y;

    VesicleVariables(const Eigen::VectorXd& states, const Eigen::VectorXd& globals)
        : y(dual_unknowns<vesicle_unknowns>(states, globals)) {}
    const VesicleNumber& operator[](Eigen::Index i) const { return y[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const VesicleNumber& pressure() const { return y[static_cast<std::size_t>(vesicle::states)]; }
};

/// κ = C(x) + m/β
VesicleNumber total_curvature(const ClosedMembrane& membrane, double x, const VesicleNumber& moment) {
    return VesicleNumber(membrane.spontaneous_curvature + membrane.polarity * (1 - 2 * x)) +
           moment / VesicleNumber(membrane.stiffness);
}

SlopeValues slope(const ClosedMembrane& membrane, double x, const Eigen::VectorXd& states,
                  const Eigen::VectorXd& globals) {
    const VesicleVariables v(states, globals);
    const VesicleNumber &y = v[vesicle::r_squared], &w = v[vesicle::cosine], &hoop = v[vesicle::hoop],
                        &m = v[vesicle::moment], &thrust = v[vesicle::thrust], &p = v.pressure();
    const VesicleNumber total = total_curvature(membrane, x, m);
    const VesicleNumber anisotropy = (total - 2.0 * hoop) / y;  // (κ1 − κ2)/r²
    std::array<VesicleNumber, vesicle_unknowns> by_a;
    const auto set = [&](Eigen::Index i, const VesicleNumber& value) { by_a[static_cast<std::size_t>(i)] = value; };
    set(vesicle::r_squared, 2.0 * w);
    set(vesicle::cosine, -hoop * (total - hoop));
    set(vesicle::hoop, w * anisotropy);
    set(vesicle::moment, thrust * hoop - 0.5 * p * w);      // normal force balance, (A.25)
    set(vesicle::thrust, m * anisotropy - 0.5 * p * hoop);  // radial force balance
    set(vesicle::height, -hoop);
    set(vesicle::volume, y * hoop);
    set(vesicle::energy, 0.5 * m * m / VesicleNumber(membrane.stiffness));
    const VesicleNumber length_of_a = membrane.area / (2 * pi);
    for (VesicleNumber& value : by_a) value = length_of_a * value;
    return slope_values<vesicle_unknowns>(by_a, vesicle::states, 1);
}

ConditionValues conditions(const ClosedMembrane& membrane, const Eigen::VectorXd& first, const Eigen::VectorXd& last,
                           const Eigen::VectorXd& globals) {
    ConditionList<vesicle_unknowns> list(vesicle::states, 1);
    const VesicleVariables north(first, globals), south(last, globals);
    list.at_first(north[vesicle::r_squared]);
    list.at_first(north[vesicle::cosine] - 1.0);
    list.at_first(total_curvature(membrane, 0, north[vesicle::moment]) - 2.0 * north[vesicle::hoop]);  // κ1 = κ2
    list.at_first(north[vesicle::height]);
    list.at_first(north[vesicle::volume]);
    list.at_first(north[vesicle::energy]);
    list.at_last(south[vesicle::r_squared]);  // cos θ = −1 follows: w² + y κ2² is constant
    list.at_last(total_curvature(membrane, 1, south[vesicle::moment]) - 2.0 * south[vesicle::hoop]);
    list.at_last(south[vesicle::volume] - membrane.volume / pi);
    return list.values();
}

}  // namespace

double ClosedMembrane::sphere_radius() const {
    return std::sqrt(area / (4 * pi));
}

double ClosedMembrane::reduced_volume() const {
    return volume / (4 * pi / 3 * std::pow(sphere_radius(), 3));
}

ClosedMembrane with_reduced_volume(ClosedMembrane membrane, double reduced_volume) {
    membrane.volume = reduced_volume * 4 * pi / 3 * std::pow(membrane.sphere_radius(), 3);
    return membrane;
}

BoundaryValueProblem vesicle_shapes(const MembranePath& path, double typical_value, double scale) {
    BoundaryValueProblem problem;
    problem.at = [path](double value) -> Equations {
        const ClosedMembrane membrane = path(value);
        return {[membrane](double x, const Eigen::VectorXd& y, const Eigen::VectorXd& g) {
                    return slope(membrane, x, y, g);
                },
                [membrane](const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& g) {
                    return conditions(membrane, first, last, g);
                }};
    };
    const ClosedMembrane typical = path(typical_value);
    const double radius = typical.sphere_radius(), beta = typical.stiffness;
    problem.state_scales.resize(vesicle::states);
    problem.state_scales << radius * radius, 1, 1 / radius, beta / radius, 4 * beta / (radius * radius), radius,
        std::pow(radius, 3), beta;
    problem.global_scales = Eigen::VectorXd::Constant(1, 10 * beta / std::pow(radius, 3));
    problem.parameter_scale = scale;
    return problem;
}

double vesicle_tension(const ClosedMembrane& membrane, const Eigen::VectorXd& y, double pressure) {
    const double m = y(vesicle::moment), hoop = y(vesicle::hoop);
    const double total = membrane.spontaneous_curvature + m / membrane.stiffness;
    return m * (total - hoop) + y(vesicle::thrust) * y(vesicle::cosine) +
           0.5 * pressure * y(vesicle::r_squared) * hoop - 0.5 * m * m / membrane.stiffness;
}

}  // namespace endoflow::statics
