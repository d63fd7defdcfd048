#include "boundary_integral/modes/azimuthal_kernels.h"

namespace endoflow::boundary_integral {

namespace {

// With sigma = sin^2(phi/2), e_r and e_phi of the target on the left and of the source on the right:
//     x.e_r = d - 2 r sigma,   x.e_phi = r sin phi     |     x.e_r = d + 2 r0 sigma,   x.e_phi = r0 sin phi
//     x.n = n0 + 2 r0 n_r sigma,   sin^2 phi = 4 sigma (1 - sigma),   d = r - r0,   b = 4 r r0.
void stokeslet(const RingPair& ring, const AzimuthalIntegrals& integrals, std::size_t k, ModeKernels& kernels) {
    const auto c1 = [&](std::size_t j) { return integrals.cosine(0, j, k); };
    const auto c3 = [&](std::size_t j) { return integrals.cosine(1, j, k); };
    const auto s3 = [&](std::size_t j) { return integrals.sine(1, j, k); };
    const double r = ring.radius, r0 = ring.target_radius, d = ring.delta_r, z = ring.delta_z;
    const double b = 4.0 * r * r0;
    const double aligned = c1(0) - 2.0 * c1(1);  // cos phi/rho
    const double turned = integrals.sine(0, 0, k);
    auto& g = kernels.single;
    g[0][0] = aligned + d * d * (c3(0) - 2.0 * c3(1)) - b * c3(2);
    g[0][1] = -turned + r0 * (d * s3(0) - 2.0 * r * s3(1));
    g[0][2] = z * (d * c3(0) - 2.0 * r * c3(1));
    g[1][0] = -turned - r * (d * s3(0) + 2.0 * r0 * s3(1));
    g[1][1] = aligned + b * (c3(1) - c3(2));
    g[1][2] = -z * r * s3(0);
    g[2][0] = z * (d * c3(0) + 2.0 * r0 * c3(1));
    g[2][1] = z * r0 * s3(0);
    g[2][2] = c1(0) + z * z * c3(0);
}

void stresslet(const RingPair& ring, const AzimuthalIntegrals& integrals, std::size_t k, ModeKernels& kernels) {
    const double n0 = ring.normal_offset, n1 = 2.0 * ring.target_radius * ring.normal_r;
    // With the factor -6 x.n/rho^5.
    const auto c = [&](std::size_t j) {
        return -6.0 * (n0 * integrals.cosine(2, j, k) + n1 * integrals.cosine(2, j + 1, k));
    };
    const auto s = [&](std::size_t j) {
        return -6.0 * (n0 * integrals.sine(2, j, k) + n1 * integrals.sine(2, j + 1, k));
    };
    const double r = ring.radius, r0 = ring.target_radius, d = ring.delta_r, z = ring.delta_z;
    const double b = 4.0 * r * r0;
    const double c0 = c(0), c1 = c(1), c2 = c(2), s0 = s(0), s1 = s(1);
    auto& t = kernels.doubled;
    t[0][0] = d * d * (c0 - 2.0 * c1) - b * c2;
    t[0][1] = r0 * (d * s0 - 2.0 * r * s1);
    t[0][2] = z * (d * c0 - 2.0 * r * c1);
    t[1][0] = -r * (d * s0 + 2.0 * r0 * s1);
    t[1][1] = b * (c1 - c2);
    t[1][2] = -z * r * s0;
    t[2][0] = z * (d * c0 + 2.0 * r0 * c1);
    t[2][1] = z * r0 * s0;
    t[2][2] = z * z * c0;
}

}  // namespace

AzimuthalKernels::AzimuthalKernels(int highest_mode)
    : integrals_(highest_mode), kernels_(static_cast<std::size_t>(highest_mode) + 1) {}

const std::vector<ModeKernels>& AzimuthalKernels::operator()(const RingPair& pair) {
    integrals_.evaluate(pair.delta_r * pair.delta_r + pair.delta_z * pair.delta_z,
                        4.0 * pair.radius * pair.target_radius);
    for (std::size_t k = 0; k < kernels_.size(); ++k) {
        stokeslet(pair, integrals_, k, kernels_[k]);
        stresslet(pair, integrals_, k, kernels_[k]);
    }
    return kernels_;
}

}  // namespace endoflow::boundary_integral
