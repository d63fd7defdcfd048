#include "boundary_integral/kernels/ring_kernels.h"

#include <cmath>
#include <numbers>

#include "boundary_integral/kernels/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

// Six steps of the mean reach round-off for 1 - m > 1e-13, seven for every positive double above 1e-26.
constexpr int mean_steps = 7;

__attribute__((always_inline)) inline EllipticIntegrals integrals_by_mean(double complementary_parameter) {
    const double root = std::sqrt(complementary_parameter);
    double arithmetic = 0.5 * (1.0 + root);
    double geometric = std::sqrt(root);
    // c_1^2 with c_1 = (1 - root)/2 and c_1^2/m = (1 - root) / (4 (1 + root)): no division by m.
    double difference_squared = 0.25 * (1.0 - root) * (1.0 - root);
    double ratio = 0.25 * (1.0 - root) / (1.0 + root);  // c_n^2 / m
    double power = 1.0;                                 // 2^(n-1)
    double sum = 0.5 + ratio;                           // (1 - E/K) / m
    for (int step = 1; step < mean_steps; ++step) {
        const double next = 0.5 * (arithmetic + geometric);
        geometric = std::sqrt(arithmetic * geometric);
        arithmetic = next;
        const double contraction = difference_squared / (16.0 * arithmetic * arithmetic);  // c_{n+1}^2 / c_n^2
        ratio *= contraction;
        difference_squared *= contraction;
        power *= 2.0;
        sum += power * ratio;
    }
    EllipticIntegrals result{};
    result.k = (0.5 * std::numbers::pi) / arithmetic;
    result.d = result.k * sum;
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
        const double total = a + 4.0 * r[i] * r0;
        const EllipticIntegrals elliptic = integrals_by_mean(a / total);
        const double scale = 4.0 / std::sqrt(total);
        const double i10 = scale * elliptic.k;
        const double i11 = scale * elliptic.b;
        const double i30 = scale * elliptic.e / a;
        const double i31 = scale * elliptic.d / total;
        g_rr[i] = i10 - 2.0 * i11 + dr[i] * dr[i] * (i30 - 2.0 * i31) - (i11 - a * i31);
        g_rz[i] = dz[i] * (dr[i] * i30 - 2.0 * r[i] * i31);
        g_zr[i] = dz[i] * (dr[i] * i30 + 2.0 * r0 * i31);
        g_zz[i] = i10 + dz[i] * dz[i] * i30;
    }
}

// x.e_r = r - r0 + 2 r0 sigma and x.e_z = z - z0, with e_r that of the source.
ENDOFLOW_VECTOR_CLONES
void pressure_loop(double r0, std::size_t count, const double* __restrict r, const double* __restrict dr,
                   const double* __restrict dz, double* __restrict p_r, double* __restrict p_z) {
    for (std::size_t i = 0; i < count; ++i) {
        const double a = dr[i] * dr[i] + dz[i] * dz[i];
        const double total = a + 4.0 * r[i] * r0;
        const EllipticIntegrals elliptic = integrals_by_mean(a / total);
        const double scale = 4.0 / std::sqrt(total);
        const double i30 = scale * elliptic.e / a;
        p_r[i] = dr[i] * i30 + 2.0 * r0 * scale * elliptic.d / total;
        p_z[i] = dz[i] * i30;
    }
}

ENDOFLOW_VECTOR_CLONES
void full_loop(double r0, std::size_t count, const double* __restrict r, const double* __restrict dr,
               const double* __restrict dz, const double* __restrict nr, const double* __restrict offset,
               double* __restrict g_rr, double* __restrict g_rz, double* __restrict g_zr, double* __restrict g_zz,
               double* __restrict t_rr, double* __restrict t_rz, double* __restrict t_zr, double* __restrict t_zz) {
    const double q = 2.0 * r0;
    for (std::size_t i = 0; i < count; ++i) {
        const double d = dr[i];
        const double z = dz[i];
        const double a = d * d + z * z;
        const double total = a + 4.0 * r[i] * r0;
        const double inverse_total = 1.0 / total;
        const double mc = a * inverse_total;
        const EllipticIntegrals elliptic = integrals_by_mean(mc);
        const double scale = 4.0 * std::sqrt(inverse_total);
        const double i10 = scale * elliptic.k;
        const double i11 = scale * elliptic.b;
        const double inverse_a = 1.0 / a;
        const double i30 = scale * elliptic.e * inverse_a;
        const double i31 = scale * elliptic.d * inverse_total;
        const double b_i32 = i11 - a * i31;  // b * i32
        g_rr[i] = i10 - 2.0 * i11 + d * d * (i30 - 2.0 * i31) - b_i32;
        g_rz[i] = z * (d * i30 - 2.0 * r[i] * i31);
        g_zr[i] = z * (d * i30 + q * i31);
        g_zz[i] = i10 + z * z * i30;

        const double third = scale * (1.0 / 3.0) * inverse_a;
        const double i50 = third * inverse_a * (2.0 * (1.0 + mc) * elliptic.e - mc * elliptic.k);
        const double i51 = third * inverse_total * (2.0 * elliptic.e - elliptic.b);
        const double b_i52 = i31 - a * i51;                         // b * i52
        const double q_b_i53 = (b_i32 - a * b_i52) / (2.0 * r[i]);  // 2 r0 b * i53
        const double n0 = offset[i];
        const double n1 = q * nr[i];  // x.n = n0 + n1 sigma
        const double t_common = z * (d * (n0 * i50 + n1 * i51));
        t_zz[i] = -6.0 * z * z * (n0 * i50 + n1 * i51);
        t_zr[i] = -6.0 * (t_common + z * (q * n0 * i51 + nr[i] * (r0 / r[i]) * b_i52));
        t_rz[i] = -6.0 * (t_common - z * (2.0 * r[i] * n0 * i51 + nr[i] * b_i52));
        t_rr[i] =
            -6.0 * (d * d * (n0 * i50 + (n1 - 2.0 * n0) * i51 - nr[i] * b_i52 / r[i]) - n0 * b_i52 - nr[i] * q_b_i53);
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

void RingKernels::resize(std::size_t count) {
    for (auto* values : {&g_rr, &g_rz, &g_zr, &g_zz, &t_rr, &t_rz, &t_zr, &t_zz}) values->resize(count);
}

EllipticIntegrals elliptic_integrals(double complementary_parameter) {
    return integrals_by_mean(complementary_parameter);
}

void evaluate_ring_pressures(double target_radius, const RingSources& sources, RingPressureKernels& kernels) {
    kernels.p_r.resize(sources.size());
    kernels.p_z.resize(sources.size());
    pressure_loop(target_radius, sources.size(), sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
                  kernels.p_r.data(), kernels.p_z.data());
}

void evaluate_ring_stokeslets(double target_radius, const RingSources& sources, RingKernels& kernels) {
    kernels.resize(sources.size());
    stokeslet_loop(target_radius, sources.size(), sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
                   kernels.g_rr.data(), kernels.g_rz.data(), kernels.g_zr.data(), kernels.g_zz.data());
}

void evaluate_ring_kernels(double target_radius, const RingSources& sources, RingKernels& kernels) {
    kernels.resize(sources.size());
    full_loop(target_radius, sources.size(), sources.radius.data(), sources.delta_r.data(), sources.delta_z.data(),
              sources.normal_r.data(), sources.normal_offset.data(), kernels.g_rr.data(), kernels.g_rz.data(),
              kernels.g_zr.data(), kernels.g_zz.data(), kernels.t_rr.data(), kernels.t_rz.data(), kernels.t_zr.data(),
              kernels.t_zz.data());
}

}  // namespace endoflow::boundary_integral
