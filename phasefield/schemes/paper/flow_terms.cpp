#include "phasefield/schemes/paper/coupled_point.h"

namespace endoflow::phasefield::paper {

namespace {

/// (32): −∇·(ν D), weakly ∫ ½ ν D(u):D(v) with the hoop term 2 ν u_r v_r / r².
void add_viscous_stress(const CoupledPoints& points, LocalSystem& local) {
    const auto nu = at_points(points, [](const auto& p) { return p.measure * p.viscosity; });
    const auto nu2 = at_points(points, [](const auto& p) { return 2 * p.measure * p.viscosity; });
    const auto hoop = at_points(points, [](const auto& p) { return 2 * p.measure * p.viscosity / (p.r * p.r); });
    local.linear(u_r, Op::dr, u_r, Op::dr, nu2);
    local.linear(u_z, Op::dz, u_z, Op::dz, nu2);
    local.linear(u_r, Op::value, u_r, Op::value, hoop);
    local.linear(u_r, Op::dz, u_r, Op::dz, nu);
    local.linear(u_r, Op::dz, u_z, Op::dr, nu);
    local.linear(u_z, Op::dr, u_r, Op::dz, nu);
    local.linear(u_z, Op::dr, u_z, Op::dr, nu);
}

/// (32), (33): ∇p weakly as −∫ p ∇·v and, with the same sign for symmetry, −∫ q ∇·u; ∇·v = v_r,r + v_r/r + v_z,z.
void add_incompressibility(const CoupledPoints& points, LocalSystem& local) {
    const auto minus = at_points(points, [](const auto& p) { return -p.measure; });
    const auto hoop = at_points(points, [](const auto& p) { return -p.measure / p.r; });
    local.linear(u_r, Op::dr, pressure, Op::value, minus);
    local.linear(u_r, Op::value, pressure, Op::value, hoop);
    local.linear(u_z, Op::dz, pressure, Op::value, minus);
    local.linear(pressure, Op::value, u_r, Op::dr, minus);
    local.linear(pressure, Op::value, u_r, Op::value, hoop);
    local.linear(pressure, Op::value, u_z, Op::dz, minus);
}

/// (32): ∇·(|∇φ| P λ), weakly −∫ |∇φ| λ P:∇v on the right, and (34): ∫ |∇φ| η P:∇u. P_θθ = 1 gives the hoop term.
void add_inextensibility(const CoupledPoints& points, LocalSystem& local) {
    const auto rr = at_points(points, [](const auto& p) { return p.measure * p.layer.gradient * p.layer.P_rr; });
    const auto rz = at_points(points, [](const auto& p) { return p.measure * p.layer.gradient * p.layer.P_rz; });
    const auto zz = at_points(points, [](const auto& p) { return p.measure * p.layer.gradient * p.layer.P_zz; });
    const auto hoop = at_points(points, [](const auto& p) { return p.measure * p.layer.gradient / p.r; });
    const auto pair = [&local](unsigned int velocity, Op derivative, const Coefficients& weight) {
        local.linear(velocity, derivative, tension, Op::value, weight);
        local.linear(tension, Op::value, velocity, derivative, weight);
    };
    pair(u_r, Op::dr, rr);
    pair(u_r, Op::dz, rz);
    pair(u_z, Op::dr, rz);
    pair(u_z, Op::dz, zz);
    pair(u_r, Op::value, hoop);
}

/// (34): ξ ε² ∇·(φ² ∇λ), weakly −∫ ξ ε² φ² ∇λ·∇η, and the relaxation −ζ |∇φ| (s − 1)/s of the stretching.
void add_tension_extension(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    const double xi = step.numerics.paper.tension_extension * step.numerics.epsilon * step.numerics.epsilon;
    const double zeta = step.numerics.paper.stretching_relaxation / step.tau;
    const auto extension =
        at_points(points, [&](const auto& p) { return -p.measure * xi * p.phi.value * p.phi.value; });
    const auto relaxation = at_points(points, [&](const auto& p) {
        return -p.measure * zeta * p.layer.gradient * (p.stretching - 1) / p.stretching;
    });
    local.linear(tension, Op::dr, tension, Op::dr, extension);
    local.linear(tension, Op::dz, tension, Op::dz, extension);
    local.residual(tension, Op::value, relaxation);
}

/// (32): ρ ( (u − uⁿ)/τ + uⁿ·∇u ). Both fluids have the same density.
void add_inertia(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    const double rho = step.fluid.density;
    const auto mass = at_points(points, [&](const auto& p) { return p.measure * rho / step.tau; });
    const auto convect_r = at_points(points, [&](const auto& p) { return p.measure * rho * p.velocity_r; });
    const auto convect_z = at_points(points, [&](const auto& p) { return p.measure * rho * p.velocity_z; });
    for (const unsigned int component : {u_r, u_z}) {
        local.linear(component, Op::value, component, Op::value, mass);
        local.linear(component, Op::value, component, Op::dr, convect_r);
        local.linear(component, Op::value, component, Op::dz, convect_z);
    }
    local.residual(u_r, Op::value,
                   at_points(points, [&](const auto& p) { return -p.measure * rho / step.tau * p.velocity_r; }));
    local.residual(u_z, Op::value,
                   at_points(points, [&](const auto& p) { return -p.measure * rho / step.tau * p.velocity_z; }));
}

}  // namespace

void add_flow_terms(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    add_viscous_stress(points, local);
    add_incompressibility(points, local);
    add_inextensibility(points, local);
    add_tension_extension(points, step, local);
    if (step.fluid.inertia) add_inertia(points, step, local);
}

}  // namespace endoflow::phasefield::paper
