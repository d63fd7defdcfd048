#include "boundary_integral/modes/azimuthal_kernels.h"

namespace endoflow::boundary_integral {

namespace {

// With sigma = sin^2(phi/2), e_r and e_phi of the target on the left and of the source on the right:
//     x.e_r = d - 2 r sigma,   x.e_phi = r sin phi     |     x.e_r = d + 2 r0 sigma,   x.e_phi = r0 sin phi
//     x.n = n0 + 2 r0 n_r sigma,   sin^2 phi = 4 sigma (1 - sigma),   d = r - r0,   b = 4 r r0.
void stokeslet(double r0, const RingSources& sources, std::size_t i, const AzimuthalIntegrals& integrals, std::size_t k,
               ModeKernels::Values& g) {
    const auto c1 = [&](std::size_t j) { return integrals.cosine(0, j, k); };
    const auto c3 = [&](std::size_t j) { return integrals.cosine(1, j, k); };
    const auto s3 = [&](std::size_t j) { return integrals.sine(1, j, k); };
    const double r = sources.radius[i], d = sources.delta_r[i], z = sources.delta_z[i];
    const double b = 4.0 * r * r0;
    const double aligned = c1(0) - 2.0 * c1(1);  // cos phi/rho
    const double turned = integrals.sine(0, 0, k);
    g[0][0][i] = aligned + d * d * (c3(0) - 2.0 * c3(1)) - b * c3(2);
    g[0][1][i] = -turned + r0 * (d * s3(0) - 2.0 * r * s3(1));
    g[0][2][i] = z * (d * c3(0) - 2.0 * r * c3(1));
    g[1][0][i] = -turned - r * (d * s3(0) + 2.0 * r0 * s3(1));
    g[1][1][i] = aligned + b * (c3(1) - c3(2));
    g[1][2][i] = -z * r * s3(0);
    g[2][0][i] = z * (d * c3(0) + 2.0 * r0 * c3(1));
    g[2][1][i] = z * r0 * s3(0);
    g[2][2][i] = c1(0) + z * z * c3(0);
}

void stresslet(double r0, const RingSources& sources, std::size_t i, const AzimuthalIntegrals& integrals, std::size_t k,
               ModeKernels::Values& t) {
    const double n0 = sources.normal_offset[i], n1 = 2.0 * r0 * sources.normal_r[i];
    // With the factor -6 x.n/rho^5.
    const auto c = [&](std::size_t j) {
        return -6.0 * (n0 * integrals.cosine(2, j, k) + n1 * integrals.cosine(2, j + 1, k));
    };
    const auto s = [&](std::size_t j) {
        return -6.0 * (n0 * integrals.sine(2, j, k) + n1 * integrals.sine(2, j + 1, k));
    };
    const double r = sources.radius[i], d = sources.delta_r[i], z = sources.delta_z[i];
    const double b = 4.0 * r * r0;
    const double c0 = c(0), c1 = c(1), c2 = c(2), s0 = s(0), s1 = s(1);
    t[0][0][i] = d * d * (c0 - 2.0 * c1) - b * c2;
    t[0][1][i] = r0 * (d * s0 - 2.0 * r * s1);
    t[0][2][i] = z * (d * c0 - 2.0 * r * c1);
    t[1][0][i] = -r * (d * s0 + 2.0 * r0 * s1);
    t[1][1][i] = b * (c1 - c2);
    t[1][2][i] = -z * r * s0;
    t[2][0][i] = z * (d * c0 + 2.0 * r0 * c1);
    t[2][1][i] = z * r0 * s0;
    t[2][2][i] = z * z * c0;
}

}  // namespace

AzimuthalKernels::AzimuthalKernels(int highest_mode)
    : integrals_(highest_mode), kernels_(static_cast<std::size_t>(highest_mode) + 1) {}

std::span<const ModeKernels> AzimuthalKernels::operator()(double target_radius, const RingSources& sources) {
    for (ModeKernels& kernels : kernels_) kernels.resize(sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const double dr = sources.delta_r[i], dz = sources.delta_z[i];
        integrals_.evaluate(dr * dr + dz * dz, 4.0 * sources.radius[i] * target_radius);
        for (std::size_t k = 0; k < kernels_.size(); ++k) {
            stokeslet(target_radius, sources, i, integrals_, k, kernels_[k].single);
            stresslet(target_radius, sources, i, integrals_, k, kernels_[k].doubled);
        }
    }
    return kernels_;
}

}  // namespace endoflow::boundary_integral
