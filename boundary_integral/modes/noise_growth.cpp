#include "boundary_integral/modes/noise_growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/modes/thermal_noise.h"
#include "boundary_integral/support/parallel.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double nonlinear_ratio = 1.0 / 3.0;  // of the neck's spread to its radius

// Steps may leave the variance that the noise has gathered below zero by their error, where it is next to nothing.
constexpr double largest_negative = 1e-2;  // nm^2

Spread spread_of(double inherited, double gathered) {
    if (!(gathered >= -largest_negative)) {
        throw SolverError("negative-variance", fmt::format("a variance of the noise is {:.2g} nm²", gathered),
                          "use more elements in the run, or a smaller --tolerance");
    }
    return {std::sqrt(inherited * inherited + std::max(gathered, 0.0)), inherited};
}

}  // namespace

NoiseGrowth::NoiseGrowth(const AlongRun& run, double temperature, double tolerance)
    : run_(run),
      thermal_energy_(boltzmann_constant * temperature),
      moment_(run.moment(0.0, 0)),
      propagation_([this](double time) { return rates(time); }, 0.0, equilibria(), first_propagation_step, tolerance,
                   thread_count(run.parameters().boundary_integral.threads)) {
    follow_neck();
}

// The coat comes at the start of the run, and lies where the case says: c' = 0.
std::vector<Covariance> NoiseGrowth::equilibria() const {
    const MembraneSpace& membrane = run_.dynamics().space();
    const BasePoints flat =
        base_points(membrane, flat_bare_membrane(membrane, moment_.evaluation.state, run_.parameters()),
                    membrane_energy(run_.parameters()), run_.surroundings().viscosities());
    std::vector<Covariance> result;
    for (int mode = 0; mode <= run_.last_mode(); ++mode) {
        const ModeSpace& space = run_.surroundings().space(mode);
        const Eigen::MatrixXd of_w = equilibrium_root(space, flat, thermal_energy_);
        const Index size = of_w.rows() + space.scalar().dimension();
        Covariance start = {Eigen::MatrixXd::Zero(size, of_w.cols()), Eigen::MatrixXd::Zero(size, size)};
        start.inherited_root.topRows(of_w.rows()) = of_w;
        result.push_back(std::move(start));
    }
    return result;
}

std::vector<NoisyRate> NoiseGrowth::rates(double time) {
    if (time != moment_.time) moment_ = run_.moment(time, 0);
    std::vector<LinearRate> linear = run_.mesh_rates(moment_);
    std::vector<NoisyRate> result;
    for (int mode = 0; mode <= run_.last_mode(); ++mode) {
        result.push_back({std::move(linear[static_cast<std::size_t>(mode)]),
                          noise_strength(mode, moment_.rates_of(mode), thermal_energy_)});
    }
    return result;
}

void NoiseGrowth::advance(double time) {
    propagation_.advance(time, [this] { follow_neck(); });
}

void NoiseGrowth::follow_neck() {
    if (linear_until_) return;
    const NoisyShape now = shape();
    if (!now.bud) return;
    const Ratio ratio = {moment_.time, now.bud->neck.total / now.bud->neck_radius};
    if (ratio.value >= nonlinear_ratio) {
        const double part = ratio_ ? (nonlinear_ratio - ratio_->value) / (ratio.value - ratio_->value) : 1.0;
        const double before = ratio_ ? ratio_->time : ratio.time;
        linear_until_ = before + part * (ratio.time - before);
    }
    ratio_ = ratio;
}

Spread NoiseGrowth::spread(const NoisyQuantity& quantity) const {
    const Covariance& covariance = propagation_.values()[static_cast<std::size_t>(quantity.mode)];
    const Index w = quantity.row.size();
    const double inherited = (quantity.row * covariance.inherited_root.topRows(w)).norm();
    const double gathered = (quantity.row * covariance.gathered.topLeftCorner(w, w) * quantity.row.transpose()).value();
    return spread_of(inherited, gathered);
}

NoisyShape NoiseGrowth::shape() const {
    const MembraneSpace& space = run_.dynamics().space();
    const Surroundings& surroundings = run_.surroundings();
    const BaseState& base = moment_.membrane->base();
    NoisyShape result;
    result.height = space.axial().basis(0.0).evaluate(base.membrane.z) - run_.parameters().domain.membrane_height;
    result.height_spread = spread(pole_height(surroundings, base));
    const auto neck = find_neck(space, base.membrane);
    if (!neck) return result;
    const BasePoint at_neck = base_point(space, base, surroundings.viscosities(), neck->t);
    const BudQuantities bud = bud_quantities(surroundings, base, *neck);
    result.bud = {neck->radius,
                  at_neck.u_n * at_neck.curve.normal_r,
                  spread(bud.neck),
                  spread(bud.sideways),
                  spread(bud.ellipticity),
                  spread(bud.neck_ellipticity)};
    return result;
}

std::array<Eigen::VectorXd, 2> NoiseGrowth::displacement(int mode) const {
    const Eigen::MatrixXd values =
        displacement_values(run_.surroundings().space(mode), meridian_points(run_.dynamics().space()));
    std::array<Eigen::VectorXd, 2> result = {Eigen::VectorXd(values.rows()), Eigen::VectorXd(values.rows())};
    for (Index i = 0; i < values.rows(); ++i) {
        const Spread at_point = spread({mode, values.row(i)});
        result[0][i] = at_point.total;
        result[1][i] = at_point.inherited;
    }
    return result;
}

Spread NoiseGrowth::rms(int mode) const {
    const Covariance& covariance = propagation_.values()[static_cast<std::size_t>(mode)];
    const Eigen::MatrixXd root =
        perturbation_norms(run_.surroundings().space(mode), moment_.membrane->points()).displacement;
    const double per_area = 2.0 * std::numbers::pi / area_of(run_.dynamics().space(), moment_.membrane->points());
    const Index w = root.rows();
    const double inherited = (root * covariance.inherited_root.topRows(w)).norm();
    const double gathered = (root * covariance.gathered.topLeftCorner(w, w) * root.transpose()).trace();
    return spread_of(std::sqrt(per_area) * inherited, per_area * gathered);
}

}  // namespace endoflow::boundary_integral
