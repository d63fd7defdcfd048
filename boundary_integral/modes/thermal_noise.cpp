#include "boundary_integral/modes/thermal_noise.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "shared/support/error.h"

namespace endoflow::boundary_integral {

double azimuthal_weight(int mode) {
    return mode == 0 ? 2.0 * std::numbers::pi : std::numbers::pi;
}

Eigen::MatrixXd second_variation(const ModeSpace& space, const BasePoints& base) {
    const MembraneSpace& membrane = space.membrane();
    const SplineSpace& splines = space.vertical();
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(splines.dimension(), splines.dimension());
    for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
        const BasePoint& p = base.points[i];
        const BasisRow row = splines.basis(membrane.xi[i], static_cast<Index>(i) / membrane.points_per_element());
        std::array<SurfaceAmplitudes, BasisRow::capacity> w{};
        for (std::size_t k = 0; k < BasisRow::capacity; ++k) w[k] = normal_displacement(space.mode(), p, row, k);
        // The volume's gradient is n, so that its second variation is int w^2 kappa dA.
        const double volume = base.pressure * p.curve.total_curvature() * p.curve.r * p.curve.g;
        for (std::size_t k = 0; k < BasisRow::capacity; ++k) {
            const SurfaceAmplitudes image = hessian_times(base.energy[i], w[k]);
            for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
                form(row.index[j], row.index[k]) +=
                    membrane.weight[i] * (dot(w[j], image) + volume * row.value[0][j] * row.value[0][k]);
            }
        }
    }
    const Eigen::MatrixXd displaced = space.displacement_expansion();
    return displaced.transpose() * form * displaced;
}

Eigen::MatrixXd equilibrium_root(const ModeSpace& space, const BasePoints& base, double thermal_energy) {
    const Eigen::MatrixXd form = second_variation(space, base);
    const Eigen::LLT<Eigen::MatrixXd> factors(form);
    if (factors.info() != Eigen::Success) {
        throw SolverError("no-thermal-equilibrium", "the membrane at rest is unstable: its fluctuations have no bound",
                          "raise membrane.rim_tension");
    }
    return std::sqrt(thermal_energy / azimuthal_weight(space.mode())) *
           factors.matrixU().solve(Eigen::MatrixXd::Identity(form.rows(), form.cols()));
}

Eigen::MatrixXd noise_strength(int mode, const ModeRates& rates, double thermal_energy) {
    return thermal_energy / azimuthal_weight(mode) *
           (rates.thermal_mobility + rates.thermal_mobility.transpose().eval());
}

BaseState flat_bare_membrane(const MembraneSpace& space, const MembraneState& state, const Parameters& parameters) {
    const Index heights = space.axial_count();
    BaseState base;
    base.membrane = {state.r, Eigen::VectorXd::Constant(heights, parameters.domain.membrane_height),
                     Eigen::VectorXd::Zero(heights)};
    base.velocity = Eigen::VectorXd::Zero(space.curve_count());
    base.force = base.traction_sum = Eigen::VectorXd::Zero(space.force_count());
    base.multipliers.tension = Eigen::VectorXd::Constant(space.tension().dimension(), parameters.membrane.rim_tension);
    return base;
}

}  // namespace endoflow::boundary_integral
