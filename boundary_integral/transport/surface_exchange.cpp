#include "boundary_integral/transport/surface_exchange.h"

#include <numbers>
#include <utility>

#include "boundary_integral/membrane/curve_variables.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::size_t var_mass = var_c1;  // the law does not know c'; m takes its place
using ExchangeDual = Dual<variable_count>;

double mass(const MembraneSpace& space, const MembraneSamples& samples) {
    double sum = 0.0;
    for (std::size_t i = 0; i < space.xi.size(); ++i)
        sum += space.weight[i] * samples.c[i] * samples.curve[i].r * samples.curve[i].g;
    return two_pi * sum;
}

/// j A with its derivatives, A = r g.
ExchangeDual rate_per_length(const CurvePoint& p, double c, double m, const ExchangeLaw& law,
                             const MembraneEnergy& bending) {
    const auto [curvature, inverse, area] = geometry<ExchangeDual>(p);
    const ExchangeDual concentration = ExchangeDual::variable(c, var_c);
    const ExchangeDual by_concentration =
        compose_partial(bending.density(curvature.value, c, 0.0), local::concentration,
                        std::array{curvature, concentration, ExchangeDual(0.0)});
    return law.rate(concentration, by_concentration, ExchangeDual::variable(m, var_mass)) * area;
}

}  // namespace

Eigen::VectorXd exchange_rate(const MembraneSpace& space, const MembraneSamples& samples, const ExchangeLaw& law,
                              const MembraneEnergy& bending) {
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(space.axial_count());
    if (law.none()) return rate;
    const double m = mass(space, samples);
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double by_concentration =
            bending.density(p.total_curvature(), samples.c[i], 0.0).partial[local::concentration];
        const double density = space.weight[i] * p.r * p.g * law.rate(samples.c[i], by_concentration, m);
        const BasisRow& phi = space.axial_rows[i];
        for (std::size_t k = 0; k < 6; ++k) rate[phi.index[k]] += density * phi.value[0][k];
    }
    return rate;
}

ExchangeDerivatives exchange_derivatives(const MembraneSpace& space, const MembraneSamples& samples,
                                         const ExchangeLaw& law, const MembraneEnergy& bending) {
    const Index axial = space.axial_count(), curve = space.curve_count();
    ExchangeDerivatives result{Eigen::MatrixXd::Zero(axial, axial), Eigen::MatrixXd::Zero(axial, curve)};
    const double m = mass(space, samples);
    Eigen::VectorXd from_mass = Eigen::VectorXd::Zero(axial);
    Eigen::RowVectorXd mass_from_c = Eigen::RowVectorXd::Zero(axial), mass_from_curve = Eigen::RowVectorXd::Zero(curve);
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double weight = space.weight[i];
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const BasisRow& phi = space.axial_rows[i];
        ExchangeDual density = rate_per_length(p, samples.c[i], m, law, bending);
        const double by_mass = std::exchange(density.partial[var_mass], 0.0);
        const ExchangeDual amount = ExchangeDual::variable(samples.c[i], var_c) * geometry<ExchangeDual>(p)[2];
        for (const Slot& column : slots.curve)
            mass_from_curve[column.row] += two_pi * weight * dot(amount.partial, column);
        for (const Slot& column : slots.concentration)
            mass_from_c[column.row] += two_pi * weight * dot(amount.partial, column);
        for (std::size_t k = 0; k < 6; ++k) {
            const double test = weight * phi.value[0][k];
            from_mass[phi.index[k]] += test * by_mass;
            for (const Slot& column : slots.curve)
                result.from_curve(phi.index[k], column.row) += test * dot(density.partial, column);
            for (const Slot& column : slots.concentration)
                result.from_c(phi.index[k], column.row) += test * dot(density.partial, column);
        }
    }
    result.from_c += from_mass * mass_from_c;
    result.from_curve += from_mass * mass_from_curve;
    return result;
}

}  // namespace endoflow::boundary_integral
