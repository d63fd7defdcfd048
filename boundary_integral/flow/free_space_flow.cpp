#include "boundary_integral/flow/free_space_flow.h"

#include <cmath>

#include "boundary_integral/flow/membrane_fluxes.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

FreeSpaceFlow::FreeSpaceFlow(const Parameters& parameters, const MembraneSpace& space)
    : FlowModel(space, {parameters.membrane.inextensible, true}),
      collocation_(space, parameters.fluid),
      threads_(thread_count(parameters.boundary_integral.threads)) {}

namespace {

/// A pressure moves nothing and no velocity has a net flux: M q = 0 = q.M up to the quadrature's error, q the gradient
/// of the volume. The pressure is a multiplier of its own, so that it does not matter of which of two close shapes M
/// is; M must then answer it: M <- S M S^T + α d d^T, S = 1 - d q^T/(q.d), with d the normal's velocity and any
/// α > 0.
void answer_pressure(const Eigen::VectorXd& volume_gradient, MobilityOperators& operators) {
    Eigen::MatrixXd& mobility = operators.mobility;
    const Eigen::VectorXd direction = operators.force_from_load * volume_gradient;
    const double scale = 1.0 / volume_gradient.dot(direction);
    const double answer = mobility.diagonal().mean() / direction.squaredNorm();
    mobility -= (scale * direction) * (volume_gradient.transpose() * mobility).eval();
    mobility -= (mobility * volume_gradient).eval() * (scale * direction).transpose();
    mobility += answer * direction * direction.transpose();
}

}  // namespace

MobilityOperators FreeSpaceFlow::operators(const MembraneState& state, const MembraneSamples& samples) const {
    LayerQuadrature quadrature;
    quadrature.threads = threads_;
    MobilityOperators result;
    result.samples = samples;
    result.freedoms = VelocityFreedoms::of_the_curve(space());
    collocation_.solve(collocation_.equation(state, samples, collocation_.targets(state), quadrature), result);
    answer_pressure(result.freedoms.restrict_rows(volume_gradient(space(), samples).transpose()), result);
    return result;
}

FlowBalances flow_balances(const MembraneSpace& space, const MobilityOperators& operators,
                           const MembraneSamples& samples, const FlowSolution& flow, const RestLevel& rest) {
    const MembraneFluxes forces = membrane_fluxes(space, operators.samples, flow);
    const MembraneFluxes motion = membrane_fluxes(space, samples, flow);
    return {std::abs(forces.force) / rest_floor(forces.force_modulus, 0.0, rest.force),
            std::abs(motion.volume) / rest_floor(motion.volume_modulus, 0.0, rest.volume_rate()),
            std::abs(motion.area_growth) / rest_floor(motion.area_modulus, 0.0, rest.area_rate())};
}

}  // namespace endoflow::boundary_integral
