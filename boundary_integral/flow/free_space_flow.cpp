#include "boundary_integral/flow/free_space_flow.h"

#include <cmath>

#include "boundary_integral/flow/membrane_fluxes.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

FreeSpaceFlow::FreeSpaceFlow(const Parameters& parameters, const MembraneSpace& space)
    : FlowModel(space, parameters.membrane.inextensible),
      collocation_(space, parameters.fluid),
      threads_(thread_count(parameters.boundary_integral.threads)) {}

namespace {

// int w.n dA of every velocity function, curve_count.
Eigen::VectorXd volume_rates(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(space.curve_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double area = space.weight[i] * p.r * p.g;
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& axial = space.axial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) {
            rates[radial.index[j]] += area * p.normal_r * radial.value[0][j];
            rates[space.radial_count() + axial.index[j]] += area * p.normal_z * axial.value[0][j];
        }
    }
    return rates;
}

// A pressure moves nothing and no velocity has a net flux: M q = 0 = q.M up to the quadrature's error. Taking the rest
// out, M <- S M S^T with S = 1 - d q^T/(q.d), keeps the volume for as long as a run lasts. d: the normal's velocity.
void remove_net_flux(const Eigen::VectorXd& flux, MobilityOperators& operators) {
    const Eigen::VectorXd direction = operators.force_from_load * flux;
    const double scale = 1.0 / flux.dot(direction);
    Eigen::MatrixXd& mobility = operators.mobility;
    mobility -= (scale * direction) * (flux.transpose() * mobility).eval();
    mobility -= (mobility * flux).eval() * (scale * direction).transpose();
}

}  // namespace

MobilityOperators FreeSpaceFlow::operators(const MembraneState& state, const MembraneSamples& samples) const {
    LayerQuadrature quadrature;
    quadrature.threads = threads_;
    MobilityOperators result;
    result.samples = samples;
    result.freedoms = VelocityFreedoms::of_the_curve(space());
    collocation_.solve(collocation_.equation(state, samples, collocation_.targets(state), quadrature), result);
    remove_net_flux(result.freedoms.restrict_rows(volume_rates(space(), samples)), result);
    return result;
}

FlowBalances flow_balances(const MembraneSpace& space, const MembraneSamples& samples, const FlowSolution& flow) {
    const MembraneFluxes fluxes = membrane_fluxes(space, samples, flow);
    constexpr double tiny = 1e-300;
    return {std::abs(fluxes.force) / (fluxes.force_modulus + tiny),
            std::abs(fluxes.volume) / (fluxes.volume_modulus + tiny),
            std::abs(fluxes.area_growth) / (fluxes.area_modulus + tiny)};
}

}  // namespace endoflow::boundary_integral
