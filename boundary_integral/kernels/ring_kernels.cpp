#include "boundary_integral/kernels/ring_kernels.h"

#include <cmath>
#include <numbers>

#include "shared/numerics/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

/// Six steps of the mean reach round-off for 1 - m > 1e-13, seven for every positive double above 1e-26.
constexpr int mean_steps = 7;

/// K, D and E of m and 1 - m, both known to full relative accuracy. (1 - E/K)/m = 1/2 + Σ 2^(n-1) c_n²/m with c_n half
/// the difference of the two means: differences of numbers near 1 miss c_n by a round-off, so c_n²/m by no more than
/// one, as c_n < m; below the least m the sum is less than that.
__attribute__((always_inline)) inline EllipticIntegrals integrals_by_mean(double m, double complementary_parameter) {
    constexpr double least = 1e-15;
    double arithmetic = 1.0, geometric = std::sqrt(complementary_parameter);
    double power = 1.0;  // 2^(n-1)
    double squares = 0.0;
    for (int step = 0; step < mean_steps; ++step) {
        const double half_difference = 0.5 * (arithmetic - geometric);
        squares += power * half_difference * half_difference;
        power *= 2.0;
        const double next = 0.5 * (arithmetic + geometric);
        geometric = std::sqrt(arithmetic * geometric);
        arithmetic = next;
    }
    EllipticIntegrals result{};
    result.k = (0.5 * std::numbers::pi) / arithmetic;
    result.d = result.k * (0.5 + squares / (m > least ? m : least));
    result.b = result.k - result.d;
    result.e = result.b + complementary_parameter * result.d;  // E = B + (1-m) D: all terms positive
    return result;
}

ENDOFLOW_VECTOR_CLONES
void stokeslet_loop(double r0, std::size_t count, const double* __restrict r, const double* __restrict dr,
                    const double* __restrict dz, double* __restrict g_rr, double* __restrict g_rz,
                    double* __restrict g_zr, double* __restrict g_zz) {
    for (std::size_t i = 0; i < count; ++i) {
        const double a = dr[i] * dr[i] + dz[i] * dz[i];
        const double b = 4.0 * r[i] * r0, inverse_total = 1.0 / (a + b);
        const EllipticIntegrals elliptic = integrals_by_mean(b * inverse_total, a * inverse_total);
        const double scale = 4.0 * std::sqrt(inverse_total);
        const double i10 = scale * elliptic.k;
        const double i11 = scale * elliptic.b;
        const double i30 = scale * elliptic.e / a;
        const double i31 = scale * elliptic.d * inverse_total;
        g_rr[i] = i10 - 2.0 * i11 + dr[i] * dr[i] * (i30 - 2.0 * i31) - (i11 - a * i31);
        g_rz[i] = dz[i] * (dr[i] * i30 - 2.0 * r[i] * i31);
        g_zr[i] = dz[i] * (dr[i] * i30 + 2.0 * r0 * i31);
        g_zz[i] = i10 + dz[i] * dz[i] * i30;
    }
}

struct KernelPoint {
    double g_rr, g_rz, g_zr, g_zz, t_rr, t_rz, t_zr, t_zz, p_r, p_z;
};

/// One source of radius r at (d, z) from the target, offset n0 = n.x. x.e_r = d + 2 r0 σ and x.e_z = z, e_r that of
/// the source.
__attribute__((always_inline)) inline KernelPoint kernels_at(double r0, double r, double d, double z, double nr,
                                                             double n0) {
    const double q = 2.0 * r0;
    const double a = d * d + z * z;
    const double b = 4.0 * r * r0;
    const double inverse_total = 1.0 / (a + b);
    const double mc = a * inverse_total;
    const EllipticIntegrals elliptic = integrals_by_mean(b * inverse_total, mc);
    const double scale = 4.0 * std::sqrt(inverse_total);
    const double i10 = scale * elliptic.k;
    const double i11 = scale * elliptic.b;
    const double inverse_a = 1.0 / a, inverse_r = 1.0 / r;
    const double i30 = scale * elliptic.e * inverse_a;
    const double i31 = scale * elliptic.d * inverse_total;
    const double b_i32 = i11 - a * i31;  // b * i32
    KernelPoint kernels{};
    kernels.g_rr = i10 - 2.0 * i11 + d * d * (i30 - 2.0 * i31) - b_i32;
    kernels.g_rz = z * (d * i30 - 2.0 * r * i31);
    kernels.g_zr = z * (d * i30 + q * i31);
    kernels.g_zz = i10 + z * z * i30;

    const double third = scale * (1.0 / 3.0) * inverse_a;
    const double i50 = third * inverse_a * (2.0 * (1.0 + mc) * elliptic.e - mc * elliptic.k);
    const double i51 = third * inverse_total * (2.0 * elliptic.e - elliptic.b);
    const double b_i52 = i31 - a * i51;                            // b * i52
    const double q_b_i53 = 0.5 * (b_i32 - a * b_i52) * inverse_r;  // 2 r0 b * i53
    const double n1 = q * nr;                                      // x.n = n0 + n1 σ
    const double t_common = z * (d * (n0 * i50 + n1 * i51));
    kernels.t_zz = -6.0 * z * z * (n0 * i50 + n1 * i51);
    kernels.t_zr = -6.0 * (t_common + z * (q * n0 * i51 + nr * r0 * inverse_r * b_i52));
    kernels.t_rz = -6.0 * (t_common - z * (2.0 * r * n0 * i51 + nr * b_i52));
    kernels.t_rr =
        -6.0 * (d * d * (n0 * i50 + (n1 - 2.0 * n0) * i51 - nr * b_i52 * inverse_r) - n0 * b_i52 - nr * q_b_i53);
    kernels.p_r = d * i30 + q * i31;
    kernels.p_z = z * i30;
    return kernels;
}

ENDOFLOW_VECTOR_CLONES
void full_loop(double r0, std::size_t count, const double* __restrict r, const double* __restrict dr,
               const double* __restrict dz, const double* __restrict nr, const double* __restrict offset,
               double* __restrict g_rr, double* __restrict g_rz, double* __restrict g_zr, double* __restrict g_zz,
               double* __restrict t_rr, double* __restrict t_rz, double* __restrict t_zr, double* __restrict t_zz) {
    for (std::size_t i = 0; i < count; ++i) {
        const KernelPoint k = kernels_at(r0, r[i], dr[i], dz[i], nr[i], offset[i]);
        g_rr[i] = k.g_rr;
        g_rz[i] = k.g_rz;
        g_zr[i] = k.g_zr;
        g_zz[i] = k.g_zz;
        t_rr[i] = k.t_rr;
        t_rz[i] = k.t_rz;
        t_zr[i] = k.t_zr;
        t_zz[i] = k.t_zz;
    }
}

/// What a source of the given densities adds to 8 π ν u and to the pressure: one value each.
ENDOFLOW_VECTOR_CLONES
void layer_loop(double r0, std::size_t count, const double* __restrict r, const double* __restrict dr,
                const double* __restrict dz, const double* __restrict nr, const double* __restrict offset,
                const double* __restrict f_r, const double* __restrict f_z, const double* __restrict u_r,
                const double* __restrict u_z, const double* __restrict q_r, const double* __restrict q_z,
                double* __restrict sum_r, double* __restrict sum_z, double* __restrict sum_p) {
    for (std::size_t i = 0; i < count; ++i) {
        const KernelPoint k = kernels_at(r0, r[i], dr[i], dz[i], nr[i], offset[i]);
        sum_r[i] = k.g_rr * f_r[i] + k.g_rz * f_z[i] - k.t_rr * u_r[i] - k.t_rz * u_z[i];
        sum_z[i] = k.g_zr * f_r[i] + k.g_zz * f_z[i] - k.t_zr * u_r[i] - k.t_zz * u_z[i];
        sum_p[i] = k.p_r * q_r[i] + k.p_z * q_z[i];
    }
}

}  // namespace

void RingSources::resize(std::size_t count) {
    radius.resize(count);
    delta_r.resize(count);
    delta_z.resize(count);
    normal_r.resize(count);
    normal_offset.resize(count);
}

EllipticIntegrals elliptic_integrals(double complementary_parameter) {
    return integrals_by_mean(1.0 - complementary_parameter, complementary_parameter);
}

void RingDensities::resize(std::size_t count) {
    for (auto* values : {&force_r, &force_z, &momentum_r, &momentum_z, &pressure_r, &pressure_z}) values->resize(count);
}

void evaluate_ring_layers(double target_radius, std::size_t count, const RingSources& sources,
                          const RingDensities& densities, RingContributions& contributions) {
    for (auto* values : {&contributions.momentum_r, &contributions.momentum_z, &contributions.pressure})
        values->resize(sources.size());
    layer_loop(target_radius, count, sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
               sources.normal_r.data(), sources.normal_offset.data(), densities.force_r.data(),
               densities.force_z.data(), densities.momentum_r.data(), densities.momentum_z.data(),
               densities.pressure_r.data(), densities.pressure_z.data(), contributions.momentum_r.data(),
               contributions.momentum_z.data(), contributions.pressure.data());
}

void evaluate_ring_stokeslets(double target_radius, const RingSources& sources, RingKernels& kernels) {
    kernels.resize(sources.size());
    auto& g = kernels.single;
    stokeslet_loop(target_radius, sources.size(), sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
                   g[0][0].data(), g[0][1].data(), g[1][0].data(), g[1][1].data());
}

void evaluate_ring_kernels(double target_radius, const RingSources& sources, RingKernels& kernels) {
    kernels.resize(sources.size());
    auto& g = kernels.single;
    auto& t = kernels.doubled;
    full_loop(target_radius, sources.size(), sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
              sources.normal_r.data(), sources.normal_offset.data(), g[0][0].data(), g[0][1].data(), g[1][0].data(),
              g[1][1].data(), t[0][0].data(), t[0][1].data(), t[1][0].data(), t[1][1].data());
}

}  // namespace endoflow::boundary_integral
