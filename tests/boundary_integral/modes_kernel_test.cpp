// The ring kernels of all azimuthal modes: against the axisymmetric ones, against adaptive quadrature, and the toroidal
// harmonics' first two against the elliptic integrals of Boost.

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/modes/azimuthal_kernels.h"

namespace {

using namespace endoflow::boundary_integral;
using Block = std::array<std::array<double, 3>, 3>;

constexpr int highest_mode = 8;

// A source ring as one target ring sees it; see RingSources.
struct RingPair {
    double target_radius, radius, delta_r, delta_z, normal_r, normal_offset;

    [[nodiscard]] RingSources source() const { return {{radius}, {delta_r}, {delta_z}, {normal_r}, {normal_offset}}; }
};

RingPair pair_of(double r0, double r, double dr, double dz) {
    const double nr = 0.6, nz = 0.8;
    return {r0, r, dr, dz, nr, nr * dr + nz * dz};
}

// Rings far apart, near each other, at distances down to 1e-3 of their radius, near the axis and on it.
std::vector<RingPair> ring_pairs() {
    std::vector<RingPair> pairs = {
        pair_of(5, 7, 2, 1), pair_of(0.3, 6, 5.7, 0.2), pair_of(6, 0.3, -5.7, 0.2),      pair_of(7, 7, 0, 30),
        pair_of(0, 4, 4, 2), pair_of(6, 7.5, 1.5, 0.5), pair_of(0.02, 0.03, 0.01, 0.005)};
    for (const double distance : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
        pairs.push_back(pair_of(1.0, 1.0 + 0.6 * distance, 0.6 * distance, 0.8 * distance));
        pairs.push_back(pair_of(1.0, 1.0 - 0.6 * distance, -0.6 * distance, 0.8 * distance));
        pairs.push_back(pair_of(1.0, 1.0, 0.0, -distance));
    }
    return pairs;
}

// One entry by adaptive quadrature in the angle, from the vectors themselves, in extended precision.
double by_quadrature(const RingPair& pair, int mode, std::size_t i, std::size_t j, bool stress) {
    using Real = long double;
    const auto integrand = [&](Real phi) {
        const Real r = pair.radius, r0 = pair.target_radius;
        const Real cosine = std::cos(phi), sine = std::sin(phi), half = std::sin(phi / 2);
        const std::array<Real, 3> at_target = {pair.delta_r - 2 * r * half * half, r * sine, pair.delta_z};
        const std::array<Real, 3> at_source = {pair.delta_r + 2 * r0 * half * half, r0 * sine, pair.delta_z};
        const std::array<std::array<Real, 3>, 3> turn = {{{cosine, -sine, 0}, {sine, cosine, 0}, {0, 0, 1}}};
        Real square = 0;
        for (const Real x : at_target) square += x * x;
        const Real rho = std::sqrt(square);
        const Real normal = pair.normal_offset + 2 * r0 * half * half * pair.normal_r;
        const Real value = stress ? -6 * at_target[i] * at_source[j] * normal / std::pow(rho, Real(5))
                                  : turn[i][j] / rho + at_target[i] * at_source[j] / (rho * square);
        if ((i == azimuthal_component) == (j == azimuthal_component)) return value * std::cos(mode * phi);
        return (i == azimuthal_component ? -1 : 1) * value * std::sin(mode * phi);
    };
    // Split where the integrand changes its scale, so that every part is smooth.
    const Real near = std::hypot(pair.delta_r, pair.delta_z) / (1e-300 + std::sqrt(pair.radius * pair.target_radius));
    Real sum = 0, low = 0;
    for (Real high = std::min(near, std::numbers::pi_v<Real>); low < std::numbers::pi_v<Real>;
         low = high, high = std::min(3 * high, std::numbers::pi_v<Real>)) {
        sum += boost::math::quadrature::gauss_kronrod<Real, 61>::integrate(integrand, low, high, 5, 1e-16L);
    }
    return static_cast<double>(2 * sum);
}

double largest(const Block& block) {
    double value = 0;
    for (const auto& row : block) {
        for (const double entry : row) value = std::max(value, std::abs(entry));
    }
    return value;
}

double largest(const ModeKernels::Values& values) {
    double value = 0;
    for (const auto& row : values) {
        for (const auto& entry : row) value = std::max(value, std::abs(entry[0]));
    }
    return value;
}

}  // namespace

TEST_CASE("mode 0 of the ring kernels is the axisymmetric kernel", "[modes]") {
    AzimuthalKernels kernels(highest_mode);
    for (const RingPair& pair : ring_pairs()) {
        RingKernels ring;
        evaluate_ring_kernels(pair.target_radius, pair.source(), ring);
        const ModeKernels& mode = kernels(pair.target_radius, pair.source())[0];
        const auto without_swirl = [](const RingKernels::Values& v, double azimuthal) {
            return Block{{{v[0][0][0], 0, v[0][1][0]}, {0, azimuthal, 0}, {v[1][0][0], 0, v[1][1][0]}}};
        };
        const Block single = without_swirl(ring.single, mode.single[1][1][0]);
        const Block doubled = without_swirl(ring.doubled, mode.doubled[1][1][0]);
        CAPTURE(pair.target_radius, pair.radius, pair.delta_r, pair.delta_z);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                // Of the largest entry: round-off of sums of some ten terms of that size.
                CHECK(std::abs(mode.single[i][j][0] - single[i][j]) < 1e-12 * largest(single));
                CHECK(std::abs(mode.doubled[i][j][0] - doubled[i][j]) < 1e-12 * largest(doubled));
            }
        }
    }
}

TEST_CASE("ring kernels of modes 0 to 8 agree with adaptive quadrature", "[modes]") {
    AzimuthalKernels kernels(highest_mode);
    for (const RingPair& pair : ring_pairs()) {
        const auto computed = kernels(pair.target_radius, pair.source());
        for (int mode = 0; mode <= highest_mode; ++mode) {
            CAPTURE(pair.target_radius, pair.radius, pair.delta_r, pair.delta_z, mode);
            const ModeKernels& kernel = computed[static_cast<std::size_t>(mode)];
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    CHECK(std::abs(kernel.single[i][j][0] - by_quadrature(pair, mode, i, j, false)) <
                          1e-12 * largest(computed[0].single));
                    CHECK(std::abs(kernel.doubled[i][j][0] - by_quadrature(pair, mode, i, j, true)) <
                          1e-12 * largest(computed[0].doubled));
                }
            }
        }
    }
}

TEST_CASE("the azimuthal coefficients of 1/rho are elliptic integrals", "[modes]") {
    AzimuthalIntegrals integrals(highest_mode);
    const double b = 2.5;
    for (const double a : {10.0, 1.0, 1e-1, 1e-3, 1e-6}) {
        CAPTURE(a);
        integrals.evaluate(a, b);
        // 1/rho = (a + b)^(-1/2) (1 - m sin^2 t)^(-1/2) with phi = pi - 2 t
        // In extended precision: the modulus says 1 - m only to its last digits.
        const long double modulus = std::sqrt(b / (static_cast<long double>(a) + b)), m = modulus * modulus;
        const double scale = 4 / std::sqrt(a + b);
        const long double k = boost::math::ellint_1(modulus), e = boost::math::ellint_2(modulus);
        CHECK(integrals.cosine(0, 0, 0) == Approx(scale * static_cast<double>(k)).epsilon(1e-12));
        // int cos(phi)/rho = scale [ (2/m - 1) K - 2 E/m ], a difference
        const auto first = static_cast<double>((2 / m - 1) * k - 2 * e / m);
        CHECK(integrals.cosine(0, 0, 1) == Approx(scale * first).epsilon(1e-12));
    }
}
