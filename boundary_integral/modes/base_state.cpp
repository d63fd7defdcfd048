#include "boundary_integral/modes/base_state.h"

#include <cmath>

namespace endoflow::boundary_integral {

namespace {

// The unit normal (-z', r')/g and its first two derivatives in xi, from derivatives of x up to the third.
void set_normal(const std::array<double, 6>& r, const std::array<double, 6>& z, BasePoint& point) {
    const double g = std::hypot(r[1], z[1]);
    const double g1 = (r[1] * r[2] + z[1] * z[2]) / g;
    const double g2 = (r[2] * r[2] + z[2] * z[2] + r[1] * r[3] + z[1] * z[3] - g1 * g1) / g;
    const auto ratio = [&](double a, double a1, double a2) {  // a/g
        const double q = a / g, q1 = (a1 - q * g1) / g;
        return Derivatives2{q, q1, (a2 - 2.0 * q1 * g1 - q * g2) / g};
    };
    point.normal_r = ratio(-z[1], -z[2], -z[3]);
    point.normal_z = ratio(r[1], r[2], r[3]);
}

Derivatives2 derivatives(const BasisRow& row, const Eigen::VectorXd& coefficients) {
    return {row.evaluate(coefficients, 0), row.evaluate(coefficients, 1), row.evaluate(coefficients, 2)};
}

}  // namespace

BaseState base_state(const MembraneDynamics& dynamics, const Evaluation& evaluation) {
    BaseState base;
    base.membrane = evaluation.state;
    base.velocity = evaluation.flow.velocity;
    base.force = evaluation.flow.force;
    base.multipliers = evaluation.flow.multipliers;
    base.inflow = evaluation.flow.inflow;
    if (const BoxFlow* box = dynamics.box()) base.walls = box->wall_unknowns(*evaluation.operators, evaluation.flow);
    return base;
}

BasePoint base_point(const MembraneSpace& space, const BaseState& base, const Viscosities& viscosities, double xi,
                     Index element) {
    const Index radial_count = space.radial_count();
    const Index piece = element < 0 ? space.radial().element_of(xi) : element;
    const BasisRow radial = space.radial().basis(xi, piece), axial = space.axial().basis(xi, piece);
    const BasisRow force = space.force().basis(xi);
    BasePoint p{};
    p.curve = curve_point(radial, axial, base.membrane);
    set_normal(space.radial().taylor(base.membrane.r, xi, piece), space.axial().taylor(base.membrane.z, xi, piece), p);
    const double g = p.curve.g, t_r = p.tangent_r(), t_z = p.tangent_z();
    const double n_r = p.curve.normal_r, n_z = p.curve.normal_z;
    p.c = axial.evaluate(base.membrane.c);
    p.c_s = axial.evaluate(base.membrane.c, 1) / g;
    p.tension = space.tension().basis(xi).evaluate(base.multipliers.tension);

    p.u_r = derivatives(radial, base.velocity.head(radial_count));
    p.u_z = derivatives(axial, base.velocity.tail(space.axial_count()));
    p.u_t = p.u_r.value * t_r + p.u_z.value * t_z;
    p.u_n = p.u_r.value * n_r + p.u_z.value * n_z;
    p.stretch_s = (p.u_r.first * t_r + p.u_z.first * t_z) / g;
    p.turning = (p.u_r.first * n_r + p.u_z.first * n_z) / g;
    p.stretch_phi = p.curve.r > 1e-12 * g ? p.u_r.value / p.curve.r : p.u_r.first / p.curve.r1;
    const double divergence = p.stretch_s + p.stretch_phi;

    const double f_r = radial.evaluate(base.force.head(radial_count));
    const double f_z = force.evaluate(base.force.tail(space.force().dimension()));
    p.f_t = f_r * t_r + f_z * t_z;
    p.f_n = f_r * n_r + f_z * n_z;
    p.stress_s = p.f_n + 2.0 * viscosities.contrast() * (divergence + p.stretch_s);
    p.stress_phi = p.f_n + 2.0 * viscosities.contrast() * (divergence + p.stretch_phi);
    const double sum_t = radial.evaluate(base.traction_sum.head(radial_count)) * t_r +
                         force.evaluate(base.traction_sum.tail(space.force().dimension())) * t_z;
    p.slope_jump = {p.f_t - viscosities.contrast() * p.turning, -viscosities.contrast() * divergence};
    p.slope_sum = {sum_t - viscosities.sum() * p.turning, -viscosities.sum() * divergence};
    return p;
}

}  // namespace endoflow::boundary_integral
