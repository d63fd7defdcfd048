#include "boundary_integral/modes/engine_state.h"

namespace endoflow::boundary_integral {

Eigen::VectorXd state_vector(const MembraneDynamics& dynamics, const MembraneState& state) {
    const MembraneSpace& space = dynamics.space();
    const Index radial = space.radial_count() - space.fixed_radial(), axial = space.axial_count() - space.fixed_axial();
    const Eigen::VectorXd moments = surface_mass_matrix(space, sample(space, state).curve) * state.c;
    Eigen::VectorXd y(dynamics.size());
    y << state.r.head(radial), state.z.head(axial), moments;
    return y;
}

BaseState engine_state(const MembraneDynamics& dynamics, const Evaluation& evaluation) {
    BaseState base;
    base.membrane = evaluation.state;
    base.velocity = evaluation.flow.velocity;
    base.force = evaluation.flow.force;
    base.multipliers = evaluation.flow.multipliers;
    base.inflow = evaluation.flow.inflow;
    if (const BoxFlow* box = dynamics.box()) base.walls = box->wall_unknowns(*evaluation.operators, evaluation.flow);
    return base;
}

// M dc/dt = dm/dt - (dM/dt) c with the mesh velocity v: (dM/dt c)_k = int phi_k c D(r g)[v] dxi.
Eigen::VectorXd concentration_rate(const MembraneDynamics& dynamics, const Evaluation& e) {
    const MembraneSpace& space = dynamics.space();
    const Eigen::VectorXd v_r = e.mesh_velocity.head(space.radial_count());
    const Eigen::VectorXd v_z = e.mesh_velocity.tail(space.axial_count());
    Eigen::VectorXd right = e.rate.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& axial = space.axial_rows[i];
        const double growth =
            radial.evaluate(v_r) * p.g + p.r / p.g * (p.r1 * radial.evaluate(v_r, 1) + p.z1 * axial.evaluate(v_z, 1));
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
            right[axial.index[j]] -= space.weight[i] * axial.value[0][j] * e.samples.c[i] * growth;
        }
    }
    return concentration_from_moments(space, e.samples.curve, right);
}

}  // namespace endoflow::boundary_integral
