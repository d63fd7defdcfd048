// The ring kernels against brute-force azimuthal integration, and the elliptic integrals against Boost.

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/kernels/ring_kernels.h"

namespace {

using namespace endoflow::boundary_integral;

struct Ring {
    double r0, z0, r, z, normal_r, normal_z;
};

RingSources source_of(const Ring& ring) {
    RingSources sources;
    sources.resize(1);
    sources.radius[0] = ring.r;
    sources.delta_r[0] = ring.r - ring.r0;
    sources.delta_z[0] = ring.z - ring.z0;
    sources.normal_r[0] = ring.normal_r;
    sources.normal_offset[0] = ring.normal_r * sources.delta_r[0] + ring.normal_z * sources.delta_z[0];
    return sources;
}

// Trapezoidal rule in the angle: spectrally accurate.
std::array<double, 8> brute_force(const Ring& ring) {
    std::array<double, 8> sum{};
    constexpr int count = 20000;
    const double weight = 2 * std::numbers::pi / count;
    for (int i = 0; i < count; ++i) {
        const double cosine = std::cos(weight * i), sine = std::sin(weight * i);
        const double x = ring.r * cosine - ring.r0, y = ring.r * sine, z = ring.z - ring.z0;
        const double rho = std::sqrt(x * x + y * y + z * z);
        const double radial = x * cosine + y * sine;  // x . e_r at the source
        const double normal = ring.normal_r * radial + ring.normal_z * z;
        const double cubed = weight / (rho * rho * rho);
        const double stress = -6 * normal * weight / std::pow(rho, 5);
        const std::array<double, 8> term = {weight * cosine / rho + x * radial * cubed,
                                            x * z * cubed,
                                            z * radial * cubed,
                                            weight / rho + z * z * cubed,
                                            stress * x * radial,
                                            stress * x * z,
                                            stress * z * radial,
                                            stress * z * z};
        for (std::size_t k = 0; k < 8; ++k) sum[k] += term[k];
    }
    return sum;
}

}  // namespace

TEST_CASE("elliptic integrals agree with Boost", "[kernels]") {
    for (const double complement : {1.0, 0.999, 0.9, 0.5, 0.1, 1e-2, 1e-3}) {
        const EllipticIntegrals ours = elliptic_integrals(complement);
        const double modulus = std::sqrt(1 - complement);
        // Boost takes the modulus k, which costs digits of 1 - k^2; 1e-12 is what is left at 1e-3.
        CHECK(ours.k == Approx(boost::math::ellint_1(modulus)).epsilon(1e-12));
        CHECK(ours.e == Approx(boost::math::ellint_2(modulus)).epsilon(1e-12));
        CHECK(ours.b + ours.d == Approx(ours.k).epsilon(1e-14));
    }
    // Logarithmic limit: K -> ln(4 / sqrt(1 - m)), next term O((1-m) ln(1-m)) = 1e-14.
    CHECK(elliptic_integrals(1e-15).k == Approx(std::log(4 / std::sqrt(1e-15))).epsilon(1e-13));
}

TEST_CASE("ring kernels are the azimuthal integrals of Stokeslet and stresslet", "[kernels]") {
    const Ring ring = GENERATE(Ring{1, 0.3, 1.5, 0.1, 0.6, 0.8}, Ring{0, 0.3, 1.5, 0.1, 0.6, 0.8},
                               Ring{1e-5, 0.3, 1.5, 0.1, 0.6, -0.8}, Ring{1, 0.3, 1e-3, 0.1, 0.6, 0.8},
                               Ring{2, 0.3, 2.02, 0.31, -0.6, 0.8}, Ring{30, 5, 2, 70, 1, 0});
    RingKernels kernels;
    evaluate_ring_kernels(ring.r0, source_of(ring), kernels);
    const auto &g = kernels.single, &t = kernels.doubled;
    const std::array<double, 8> ours = {g[0][0][0], g[0][1][0], g[1][0][0], g[1][1][0],
                                        t[0][0][0], t[0][1][0], t[1][0][0], t[1][1][0]};
    const std::array<double, 8> expected = brute_force(ring);
    for (std::size_t k = 0; k < 8; ++k) {
        CAPTURE(k, ours[k], expected[k]);
        // Round-off of the oracle's sum; sources near the axis lose the factor r that the surface measure gives back.
        CHECK(std::abs(ours[k] - expected[k]) < 2e-12 * (1 + std::abs(expected[k])));
    }
}

TEST_CASE("the single-layer kernels alone agree with the full evaluation", "[kernels]") {
    const Ring ring{2, 0.3, 2.5, 0.9, 0.6, 0.8};
    RingKernels full, single;
    evaluate_ring_kernels(ring.r0, source_of(ring), full);
    evaluate_ring_stokeslets(ring.r0, source_of(ring), single);
    CHECK(single.single[0][0][0] == Approx(full.single[0][0][0]).epsilon(1e-14));
    CHECK(single.single[1][1][0] == Approx(full.single[1][1][0]).epsilon(1e-14));
}
