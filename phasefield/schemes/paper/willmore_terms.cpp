#include "phasefield/schemes/paper/coupled_point.h"

namespace endoflow::phasefield::paper {

namespace {

/// The mixture of old and new: ∇φ_w = (1 − w) ∇φⁿ + w ∇φ.
struct MixedGradient {
    Coefficients r, z;
};

MixedGradient mixed_gradient(const CoupledPoints& points, double w, const LocalSystem& local) {
    const ScalarField& now = local.field(phi);
    return {at_points(points, [&](const auto& p, std::size_t q) { return (1 - w) * p.phi.r + w * now.r[q]; }),
            at_points(points, [&](const auto& p, std::size_t q) { return (1 - w) * p.phi.z + w * now.z[q]; })};
}

/// (35) tested with g's functions: −∫ (u·∇φ_w) ψ. w = 0 as printed adds anti-diffusion to the profile; w = ½ none.
void add_advection(const CoupledPoints& points, double w, LocalSystem& local) {
    const auto gradient = mixed_gradient(points, w, local);
    const auto &ur = local.field(u_r).value, &uz = local.field(u_z).value;
    local.linear(force, Op::value, u_r, Op::value,
                 at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * gradient.r[q]; }));
    local.linear(force, Op::value, u_z, Op::value,
                 at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * gradient.z[q]; }));
    if (w == 0) return;
    local.jacobian(force, Op::value, phi, Op::dr,
                   at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * w * ur[q]; }));
    local.jacobian(force, Op::value, phi, Op::dz,
                   at_points(points, [&](const auto& p, std::size_t q) { return -p.measure * w * uz[q]; }));
}

/// (32): the membrane force −∫ g ∇φ_w·v. With w = 1 it and the force on ∇c balance to zero in total, as an energy that
/// does not depend on the membrane's place demands; with w = 0 (as printed) the rest, of the order of the step, drives
/// the flow. `printed` is the sign in front of g ∇φ on the right: +1 in (20) and (32), −1 in Sec. 3.
void add_membrane_force(const CoupledPoints& points, double w, double printed, LocalSystem& local) {
    const auto gradient = mixed_gradient(points, w, local);
    const auto& g = local.field(force).value;
    local.linear(u_r, Op::value, force, Op::value,
                 at_points(points, [&](const auto& p, std::size_t q) { return -printed * p.measure * gradient.r[q]; }));
    local.linear(u_z, Op::value, force, Op::value,
                 at_points(points, [&](const auto& p, std::size_t q) { return -printed * p.measure * gradient.z[q]; }));
    if (w == 0) return;
    const auto change =
        at_points(points, [&](const auto& p, std::size_t q) { return -printed * p.measure * w * g[q]; });
    local.jacobian(u_r, Op::value, phi, Op::dr, change);
    local.jacobian(u_z, Op::value, phi, Op::dz, change);
}

/// (32): the force −∫ e ∇cⁿ·v of (20), e = (1 − w) e(φⁿ, mⁿ) + w e(φ, m).
void add_concentration_force(const CoupledPoints& points, double w, double epsilon, LocalSystem& local) {
    const auto& now = local.field(phi).value;
    const auto& unknown = local.field(moment).value;
    Coefficients value(points.size()), by_moment(points.size()), by_phi(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
        const auto& p = points[q];
        const auto before = concentration_force(p.phi.value, p.moment, p.bending, epsilon);
        const auto after = concentration_force(now[q], p.moment_per_unknown * unknown[q], p.bending, epsilon);
        value[q] = -p.measure * ((1 - w) * before.value + w * after.value);
        by_moment[q] = -p.measure * w * after.moment * p.moment_per_unknown;
        by_phi[q] = -p.measure * w * after.phi;
    }
    const auto add = [&](unsigned int velocity, const auto& slope) {
        const auto times = [&](const Coefficients& factor) {
            return at_points(points, [&](const auto& p, std::size_t q) { return factor[q] * slope(p); });
        };
        local.residual(velocity, Op::value, times(value));
        if (w == 0) return;
        local.jacobian(velocity, Op::value, moment, Op::value, times(by_moment));
        local.jacobian(velocity, Op::value, phi, Op::value, times(by_phi));
    };
    add(u_r, [](const auto& p) { return p.c_r; });
    add(u_z, [](const auto& p) { return p.c_z; });
}

/// (35): −(φ − φⁿ)/τ − γ g.
void add_phase_field_rate(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    local.linear(force, Op::value, phi, Op::value,
                 at_points(points, [&](const auto& p, std::size_t) { return -p.measure / step.tau; }));
    local.residual(force, Op::value,
                   at_points(points, [&](const auto& p, std::size_t) { return p.measure / step.tau * p.phi.value; }));
    local.linear(force, Op::value, force, Op::value, at_points(points, [&](const auto& p, std::size_t) {
                     return -p.measure * step.numerics.paper.mobility;
                 }));
}

/// Added to the right of (35): M W ( ε ∂_nn φ + φ(1 − φ²)/ε ), weakly −M ε ∫ (n·∇φ)( W n·∇ψ + ψ ∇·(n W) ) + …, with n
/// and the weight W from time level n. It restores the equilibrium profile along the normal and, being free of the
/// curvature term, does not move the interface.
void add_profile_relaxation(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local) {
    const double M = step.numerics.paper.profile_mobility, epsilon = step.numerics.epsilon;
    const auto diffusion = [&](const auto& p) { return -p.measure * M * epsilon * p.relaxation.weight; };
    const auto drift = [&](const auto& p) {
        return -p.measure * M * epsilon * p.relaxation.weighted_normal_divergence;
    };
    const auto reaction = [&](const auto& p) { return p.measure * M / epsilon * p.relaxation.weight; };
    const auto add = [&](Op test_op, Op trial_op, const auto& coefficient) {
        local.linear(force, test_op, phi, trial_op,
                     at_points(points, [&](const auto& p, std::size_t) { return coefficient(p); }));
    };
    add(Op::dr, Op::dr, [&](const auto& p) { return diffusion(p) * p.relaxation.normal_r * p.relaxation.normal_r; });
    add(Op::dr, Op::dz, [&](const auto& p) { return diffusion(p) * p.relaxation.normal_r * p.relaxation.normal_z; });
    add(Op::dz, Op::dr, [&](const auto& p) { return diffusion(p) * p.relaxation.normal_z * p.relaxation.normal_r; });
    add(Op::dz, Op::dz, [&](const auto& p) { return diffusion(p) * p.relaxation.normal_z * p.relaxation.normal_z; });
    add(Op::value, Op::dr, [&](const auto& p) { return drift(p) * p.relaxation.normal_r; });
    add(Op::value, Op::dz, [&](const auto& p) { return drift(p) * p.relaxation.normal_z; });
    const auto& now = local.field(phi).value;
    local.residual(force, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return reaction(p) * now[q] * (1 - now[q] * now[q]);
                   }));
    local.jacobian(force, Op::value, phi, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return reaction(p) * (1 - 3 * now[q] * now[q]);
                   }));
}

/// (36) tested with φ's functions θ:  ∫ g θ + a ( ∇m·∇θ + m F'(φ) θ/ε ) = 0 with m = β f = w X, X being the unknown.
void add_membrane_force_definition(const CoupledPoints& points, double epsilon, bool unknown_varies,
                                   LocalSystem& local) {
    const auto& now = local.field(phi).value;
    const auto& unknown = local.field(moment).value;
    const double a = energy_prefactor;
    const auto F = [&](const auto& p, std::size_t q) { return well_force(now[q], p.bending.curvature, epsilon); };
    local.linear(phi, Op::value, force, Op::value,
                 at_points(points, [](const auto& p, std::size_t) { return p.measure; }));
    const auto add = [&](Op test_op, Op trial_op, const auto& coefficient) {
        local.linear(phi, test_op, moment, trial_op, at_points(points, [&](const auto& p, std::size_t q) {
                         return p.measure * a * coefficient(p, q);
                     }));
    };
    const auto w = [](const auto& p, std::size_t) { return p.moment_per_unknown; };
    add(Op::dr, Op::dr, w);
    add(Op::dz, Op::dz, w);
    if (unknown_varies) {
        add(Op::dr, Op::value, [](const auto& p, std::size_t) { return p.per_unknown_r; });
        add(Op::dz, Op::value, [](const auto& p, std::size_t) { return p.per_unknown_z; });
    }
    add(Op::value, Op::value, [&](const auto& p, std::size_t q) { return w(p, q) * F(p, q).phi / epsilon; });
    local.jacobian(phi, Op::value, phi, Op::value, at_points(points, [&](const auto& p, std::size_t q) {
                       return p.measure * a / epsilon * w(p, q) * unknown[q] * F(p, q).phiphi;
                   }));
}

/// (37) tested with the unknown's functions χ and scaled by a/ε:  (a/ε) ∫ w X χ/β + ε ∇φ·∇χ + F(φ, c) χ = 0.
void add_moment_definition(const CoupledPoints& points, double epsilon, LocalSystem& local) {
    const auto& now = local.field(phi).value;
    const double a = energy_prefactor;
    const auto F = [&](const auto& p, std::size_t q) { return well_force(now[q], p.bending.curvature, epsilon); };
    local.linear(moment, Op::value, moment, Op::value, at_points(points, [&](const auto& p, std::size_t) {
                     return p.measure * a * p.moment_per_unknown / (epsilon * p.bending.stiffness);
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
    add_advection(points, step.numerics.paper.advection_centering, local);
    add_membrane_force(points, step.numerics.paper.force_centering,
                       step.numerics.paper.force_sign == ForceSign::plus ? 1 : -1, local);
    add_concentration_force(points, step.numerics.paper.force_centering, epsilon, local);
    add_phase_field_rate(points, step, local);
    if (step.numerics.paper.profile_mobility > 0) add_profile_relaxation(points, step, local);
    add_membrane_force_definition(points, epsilon, step.numerics.paper.bending_unknown == BendingUnknown::f, local);
    add_moment_definition(points, epsilon, local);
}

}  // namespace endoflow::phasefield::paper
