#include "phasefield/monolithic/coupled_point.h"

namespace endoflow::phasefield {

namespace {

template <class Function>
Coefficients at_points(const CoupledPoints& points, const Function& coefficient) {
    Coefficients out(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) out[q] = coefficient(points[q], q);
    return out;
}

/// The mixture of old and new φ that u and g meet: φ_α = (1 − α) φⁿ + α φ. α = 0 as printed; α = ½ is second order and
/// adds no anti-diffusion to the profile.
struct MixedGradient {
    Coefficients r, z;
};

MixedGradient mixed_gradient(const CoupledPoints& points, double alpha, const LocalSystem& local) {
    const ScalarField& now = local.field(phi);
    return {at_points(points, [&](const auto& p, std::size_t q) { return (1 - alpha) * p.phi.r + alpha * now.r[q]; }),
            at_points(points, [&](const auto& p, std::size_t q) { return (1 - alpha) * p.phi.z + alpha * now.z[q]; })};
}

/// (32): the membrane force −∫ g ∇φ·v, and (35) tested with g's functions, −∫ (u·∇φ) ψ: one is the other's transpose.
void add_advection_and_membrane_force(const CoupledPoints& points, double alpha, LocalSystem& local) {
    const auto gradient = mixed_gradient(points, alpha, local);
    const auto& g = local.field(force).value;
    const auto &ur = local.field(u_r).value, &uz = local.field(u_z).value;
    const auto r = at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * gradient.r[q]; });
    const auto z = at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * gradient.z[q]; });
    local.linear(u_r, Op::value, force, Op::value, r);
    local.linear(u_z, Op::value, force, Op::value, z);
    local.linear(force, Op::value, u_r, Op::value, r);
    local.linear(force, Op::value, u_z, Op::value, z);
    if (alpha == 0) return;
    const auto g_weight = at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * alpha * g[q]; });
    local.jacobian(u_r, Op::value, phi, Op::dr, g_weight);
    local.jacobian(u_z, Op::value, phi, Op::dz, g_weight);
    local.jacobian(force, Op::value, phi, Op::dr,
                   at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * alpha * ur[q]; }));
    local.jacobian(force, Op::value, phi, Op::dz,
                   at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * alpha * uz[q]; }));
}

/// (35): −(φ − φⁿ)/τ − γ g.
void add_phase_field_rate(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    local.linear(force, Op::value, phi, Op::value,
                 at_points(points, [&](const auto& p, std::size_t) { return -p.measure / step.tau; }));
    local.residual(force, Op::value,
                   at_points(points, [&](const auto& p, std::size_t) { return p.measure / step.tau * p.phi.value; }));
    local.linear(force, Op::value, force, Op::value,
                 at_points(points, [&](const auto& p, std::size_t) { return -p.measure * step.numerics.mobility; }));
}

/// Added to the right of (35): M ( ε ∂_nn φ + φ(1 − φ²)/ε ), weakly −M ε ∫ (n·∇φ)(n·∇ψ + ψ ∇·n) + …, n from time level
/// n. It restores the equilibrium profile along the normal and, being free of the curvature term, does not move the
/// interface.
void add_profile_relaxation(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    const double M = step.numerics.profile_mobility, epsilon = step.numerics.epsilon;
    const auto weight = [&](const auto& p) { return -p.measure * M * epsilon; };
    local.linear(force, Op::dr, phi, Op::dr, at_points(points, [&](const auto& p, std::size_t) {
                     return weight(p) * p.layer.normal_r * p.layer.normal_r;
                 }));
    const auto mixed =
        at_points(points, [&](const auto& p, std::size_t) { return weight(p) * p.layer.normal_r * p.layer.normal_z; });
    local.linear(force, Op::dr, phi, Op::dz, mixed);
    local.linear(force, Op::dz, phi, Op::dr, mixed);
    local.linear(force, Op::dz, phi, Op::dz, at_points(points, [&](const auto& p, std::size_t) {
                     return weight(p) * p.layer.normal_z * p.layer.normal_z;
                 }));
    local.linear(force, Op::value, phi, Op::dr, at_points(points, [&](const auto& p, std::size_t) {
                     return weight(p) * p.normal_divergence * p.layer.normal_r;
                 }));
    local.linear(force, Op::value, phi, Op::dz, at_points(points, [&](const auto& p, std::size_t) {
                     return weight(p) * p.normal_divergence * p.layer.normal_z;
                 }));
    const auto& now = local.field(phi).value;
    local.residual(force, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * M / epsilon * now[q] * (1 - now[q] * now[q]);
                   }));
    local.jacobian(force, Op::value, phi, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * M / epsilon * (1 - 3 * now[q] * now[q]);
                   }));
}

/// (36) tested with φ's functions θ:  ∫ g θ + a ( ∇m·∇θ + m F'(φ) θ/ε ) = 0 with m = β f.
void add_membrane_force_definition(const CoupledPoints& points, double epsilon, LocalSystem& local) {
    const auto& now = local.field(phi).value;
    const auto& m = local.field(moment).value;
    const double a = energy_prefactor;
    const auto F = [&](const auto& p, std::size_t q) { return well_force(now[q], p.bending.curvature, epsilon); };
    local.linear(phi, Op::value, force, Op::value,
                 at_points(points, [](const auto& p, std::size_t) { return p.measure; }));
    const auto stiffness = at_points(points, [&](const auto& p, std::size_t) { return p.measure * a; });
    local.linear(phi, Op::dr, moment, Op::dr, stiffness);
    local.linear(phi, Op::dz, moment, Op::dz, stiffness);
    local.linear(phi, Op::value, moment, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                     return p.measure * a / epsilon * F(p, q).phi;
                 }));
    local.jacobian(phi, Op::value, phi, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * a / epsilon * m[q] * F(p, q).phiphi;
                   }));
}

/// (37) tested with the moment's functions χ and scaled by a/ε:  (a/ε) ∫ m χ/β + ε ∇φ·∇χ + F(φ, c) χ = 0.
void add_moment_definition(const CoupledPoints& points, double epsilon, LocalSystem& local) {
    const auto& now = local.field(phi).value;
    const double a = energy_prefactor;
    const auto F = [&](const auto& p, std::size_t q) { return well_force(now[q], p.bending.curvature, epsilon); };
    local.linear(moment, Op::value, moment, Op::value, at_points(points, [&](const auto& p, std::size_t) {
                     return p.measure * a / (epsilon * p.bending.stiffness);
                 }));
    const auto stiffness = at_points(points, [&](const auto& p, std::size_t) { return p.measure * a; });
    local.linear(moment, Op::dr, phi, Op::dr, stiffness);
    local.linear(moment, Op::dz, phi, Op::dz, stiffness);
    local.residual(moment, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * a / epsilon * F(p, q).value;
                   }));
    local.jacobian(moment, Op::value, phi, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * a / epsilon * F(p, q).phi;
                   }));
}

}  // namespace

void add_willmore_terms(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    const double epsilon = step.numerics.epsilon;
    add_advection_and_membrane_force(points, step.numerics.advection_centering, local);
    add_phase_field_rate(points, step, local);
    if (step.numerics.profile_mobility > 0) add_profile_relaxation(points, step, local);
    add_membrane_force_definition(points, epsilon, local);
    add_moment_definition(points, epsilon, local);
}

}  // namespace endoflow::phasefield
