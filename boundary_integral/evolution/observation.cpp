#include "boundary_integral/evolution/observation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/numerics/gauss_legendre.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// The spline as it is: r and r' at any ξ.
class SplineMeridian : public Meridian {
  public:
    SplineMeridian(const MembraneSpace& space, const MembraneState& state) : space_(space), state_(state) {
        constexpr Index knots_per_element = 4;
        const Index intervals = knots_per_element * space.elements();
        for (Index i = 0; i <= intervals; ++i)
            knots_.push_back(static_cast<double>(i) / static_cast<double>(intervals));
    }
    [[nodiscard]] const std::vector<double>& knots() const override { return knots_; }
    [[nodiscard]] double radius(double xi) const override { return space_.radial().basis(xi).evaluate(state_.r); }
    [[nodiscard]] double slope(double xi) const override { return space_.radial().basis(xi).evaluate(state_.r, 1); }

  private:
    const MembraneSpace& space_;
    const MembraneState& state_;
    std::vector<double> knots_;
};

const QuadratureRule& arc_length_rule() {
    static const QuadratureRule rule = gauss_legendre(4);
    return rule;
}

double height(const MembraneSpace& space, const MembraneSamples& samples, const MembraneState& state,
              const DomainParameters& domain) {
    const bool closed = space.end() == CurveEnd::closed;
    const double axis = space.axial().basis(0.0).evaluate(state.z), end = space.axial().basis(1.0).evaluate(state.z);
    double highest = std::max(axis, end), lowest = std::min(axis, end);
    for (const CurvePoint& p : samples.curve) {
        highest = std::max(highest, p.z);
        lowest = std::min(lowest, p.z);
    }
    return bud_height_between(highest, lowest, domain.membrane_height, closed);
}

}  // namespace

std::optional<Neck> find_neck(const MembraneSpace& space, const MembraneState& state) {
    return find_neck(SplineMeridian(space, state));
}

double area_within(const MembraneSpace& space, const MembraneState& state, double xi) {
    const MeridianPoints points = points_before(space, state, xi);
    double area = 0.0;
    for (std::size_t i = 0; i < points.xi.size(); ++i)
        area += two_pi * points.weight[i] * points.curve[i].r * points.curve[i].g;
    return area;
}

ShapeMeasures measure_shape(const MembraneSpace& space, const MembraneState& state, const DomainParameters& domain) {
    const MembraneSamples samples = sample(space, state);
    ShapeMeasures result;
    result.neck = find_neck(space, state);
    result.bud_height = height(space, samples, state, domain);
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double ring = two_pi * space.weight[i] * p.r;
        result.membrane_area += ring * p.g;
        result.extracellular_volume += ring * p.r1 * (p.z - domain.membrane_height);
    }
    return result;
}

double molecule_mass(const MembraneSpace& space, const MembraneSamples& samples) {
    double mass = 0.0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        mass += two_pi * space.weight[i] * p.r * p.g * samples.c[i];
    }
    return mass;
}

WallDistance wall_distance(const MembraneSpace& space, const MembraneSamples& samples, const DomainParameters& domain) {
    double to_rim = 0.0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) to_rim += space.weight[i] * samples.curve[i].g;
    WallDistance walls(domain);
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        to_rim -= space.weight[i] * p.g;
        walls.look_at(p.r, p.z, to_rim);
    }
    return walls;
}

double EnergyBalance::moduli() const {
    return std::abs(dissipated_power) + molecular_dissipation + std::abs(exchange_power) + std::abs(maturation_power);
}

double EnergyBalance::residual(double floor) const {
    return std::abs(energy_rate + dissipated_power - diffusive_power - external_power - maturation_power) /
           std::max(moduli(), floor);
}

Eigen::VectorXd moments_of_concentration_rate(const MembraneDynamics& dynamics, const Evaluation& e) {
    const MembraneSpace& space = dynamics.space();
    const Eigen::VectorXd w_r = e.mesh_velocity.head(space.radial_count());
    const Eigen::VectorXd w_z = e.mesh_velocity.tail(space.axial_count());
    Eigen::VectorXd moments = e.rate.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const BasisRow& phi = space.axial_rows[i];
        const double growth = space.radial_rows[i].evaluate(w_r, 0) * p.g +
                              p.r / p.g * (p.r1 * space.radial_rows[i].evaluate(w_r, 1) + p.z1 * phi.evaluate(w_z, 1));
        for (std::size_t j = 0; j < BasisRow::capacity; ++j)
            moments[phi.index[j]] -= space.weight[i] * phi.value[0][j] * e.samples.c[i] * growth;
    }
    return moments;
}

EnergyBalance energy_balance(const MembraneDynamics& dynamics, const Evaluation& e) {
    const MembraneSpace& space = dynamics.space();
    EnergyBalance balance{};
    balance.energy = two_pi * e.energy.energy;
    Eigen::VectorXd advected = Eigen::VectorXd::Zero(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const BasisRow& phi = space.axial_rows[i];
        // Transport by the material alone leaves c constant along it: dc/dt at fixed ξ = - v c'/g.
        const double carried = -e.relative_velocity[i] * e.samples.c1[i] / p.g * p.r * p.g;
        for (std::size_t j = 0; j < BasisRow::capacity; ++j)
            advected[phi.index[j]] += space.weight[i] * phi.value[0][j] * carried;
    }
    const LuFactors mass(surface_mass_matrix(space, e.samples.curve), "concentration mass");
    const Eigen::VectorXd c_rate = mass.solve(moments_of_concentration_rate(dynamics, e));
    const Eigen::VectorXd c_carried = mass.solve(advected);
    balance.maturation_power = dynamics.maturation_power(e);
    balance.energy_rate =
        two_pi * (e.energy.gradient.dot(e.mesh_velocity) + e.energy.gradient_c.dot(c_rate)) + balance.maturation_power;
    balance.diffusive_power = two_pi * e.energy.gradient_c.dot(c_rate - c_carried);
    balance.dissipated_power = e.flow.power;
    balance.external_power = e.flow.external_power;
    const auto power_of = [&](const Eigen::VectorXd& rate) {  // of the moments, at fixed curve
        const Eigen::VectorXd change = mass.solve(rate);
        return two_pi * e.energy.gradient_c.dot(change);
    };
    if (dynamics.transport().energetic) balance.molecular_dissipation = -power_of(e.diffusion);
    balance.exchange_power = power_of(e.exchange);
    return balance;
}

CurveSampler::CurveSampler(const MembraneSpace& space, Index intervals) : space_(space) {
    const auto point = [&space](double xi) {
        return Point{space.radial().basis(xi), space.axial().basis(xi), space.tension().basis(xi)};
    };
    const double step = 1.0 / static_cast<double>(intervals);
    for (Index i = 0; i <= intervals; ++i) {
        const double xi = static_cast<double>(i) * step;
        points_.push_back(point(xi));
        if (i == intervals) break;
        for (const double node : arc_length_rule().nodes) between_.push_back(point(xi + 0.5 * step * (1.0 + node)));
    }
}

MembraneCurve CurveSampler::operator()(const MembraneState& state, const FlowSolution& flow) const {
    MembraneCurve curve;
    const Eigen::VectorXd u_r = flow.velocity.head(space_.radial_count());
    const Eigen::VectorXd u_z = flow.velocity.tail(space_.axial_count());
    const std::vector<double>& weights = arc_length_rule().weights;
    const std::size_t last = points_.size() - 1;
    double arc_length = 0.0;
    for (std::size_t i = 0; i <= last; ++i) {
        const Point& point = points_[i];
        const CurvePoint p = curve_point(point.radial, point.axial, state);
        const bool on_axis = i == 0 || (i == last && space_.end() == CurveEnd::closed);
        curve.s.push_back(arc_length);
        curve.r.push_back(on_axis ? 0.0 : p.r);
        curve.z.push_back(p.z);
        curve.c.push_back(point.axial.evaluate(state.c));
        curve.lambda.push_back(point.tension.evaluate(flow.multipliers.tension));
        curve.kappa.push_back(p.total_curvature());
        curve.u_r.push_back(on_axis ? 0.0 : point.radial.evaluate(u_r));
        curve.u_z.push_back(point.axial.evaluate(u_z));
        for (std::size_t q = 0; i < last && q < weights.size(); ++q) {
            const Point& middle = between_[i * weights.size() + q];
            arc_length +=
                0.5 / static_cast<double>(last) * weights[q] * curve_point(middle.radial, middle.axial, state).g;
        }
    }
    return curve;
}

}  // namespace endoflow::boundary_integral
