#include "boundary_integral/modes/azimuthal_integrals.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "boundary_integral/kernels/ring_kernels.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t powers = 3;  // rho^-1, rho^-3, rho^-5
constexpr double digits = 38.0;    // e^-38 is below round-off

// The planner of FFTW may run in one thread at a time.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

// Cosine transform of 1/rho^p from its values at phi = i pi/half, i = 0 ... 2 half - 1, for the three powers at once:
// the real parts of a Fourier transform. FFTW's cosine transforms (REDFT00) allocate at each execution.
struct AzimuthalIntegrals::Transform {
    explicit Transform(std::size_t half_points)
        : half(half_points), values(powers * 2 * half), transformed(powers * 2 * half) {
        for (std::size_t i = 0; i <= half; ++i) {
            const double sine = std::sin(0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(half));
            sigma.push_back(sine * sine);
        }
        const std::scoped_lock lock(planner());
        const int length = static_cast<int>(2 * half);
        const fftw_r2r_kind kind = FFTW_R2HC;
        plan = fftw_plan_many_r2r(1, &length, powers, values.data(), nullptr, 1, length, transformed.data(), nullptr, 1,
                                  length, &kind, FFTW_ESTIMATE);
    }
    ~Transform() {
        const std::scoped_lock lock(planner());
        fftw_destroy_plan(plan);
    }
    Transform(const Transform&) = delete;
    Transform& operator=(const Transform&) = delete;

    std::size_t half;
    std::vector<double> sigma;
    std::vector<double> values, transformed;
    fftw_plan plan;
};

AzimuthalIntegrals::AzimuthalIntegrals(int highest)
    : highest_(static_cast<std::size_t>(highest)), count_(highest_ + extra + 1) {
    // The trapezoidal rule with N points takes the orders N - k for k: they have decayed by e^{-(N - k) acosh(chi)}.
    const std::size_t half = std::max<std::size_t>(32, 2 * count_);
    transform_ = std::make_unique<Transform>(half);
    well_apart_ = std::cosh(digits / static_cast<double>(2 * half - count_));
    for (auto& weights : cosine_) weights.fill(Orders(count_, 0.0));
    for (auto& weights : sine_) weights.fill(Orders(count_, 0.0));
}

AzimuthalIntegrals::~AzimuthalIntegrals() = default;

void AzimuthalIntegrals::evaluate(double a, double b) {
    if (2.0 * a > (well_apart_ - 1.0) * b) {
        by_transform(a, b);
    } else {
        by_recurrence(a, b);
    }
}

void AzimuthalIntegrals::by_transform(double a, double b) {
    Transform& t = *transform_;
    const std::size_t stride = 2 * t.half;
    for (std::size_t i = 0; i <= t.half; ++i) {
        const double inverse = 1.0 / (a + b * t.sigma[i]);
        const double first = std::sqrt(inverse);
        t.values[i] = first;
        t.values[stride + i] = first * inverse;
        t.values[2 * stride + i] = first * inverse * inverse;
    }
    for (std::size_t p = 0; p < powers; ++p)
        for (std::size_t i = 1; i < t.half; ++i) t.values[(p + 1) * stride - i] = t.values[p * stride + i];
    fftw_execute(t.plan);
    const double scale = std::numbers::pi / static_cast<double>(t.half);
    for (std::size_t p = 0; p < powers; ++p) {
        for (std::size_t k = 0; k < count_; ++k) cosine_[p][0][k] = scale * t.transformed[p * stride + k];
        // sigma = (1 - cos phi)/2; the highest order is used up at each multiplication.
        for (std::size_t j = 0; j < 3; ++j) {
            const Orders& from = cosine_[p][j];
            for (std::size_t k = 0; k + 1 + j < count_; ++k) {
                const double below = from[k == 0 ? 1 : k - 1];
                cosine_[p][j + 1][k] = 0.5 * from[k] - 0.25 * (below + from[k + 1]);
            }
        }
        for (std::size_t j = 0; j < 3; ++j) {
            const Orders& from = cosine_[p][j];
            for (std::size_t k = 1; k <= highest_; ++k) sine_[p][j][k] = 0.5 * (from[k - 1] - from[k + 1]);
        }
    }
}

// c_k^1 for all orders: upwards where that loses no digit, else downwards from far above (Miller).
void AzimuthalIntegrals::toroidal_harmonics(double a, double b, double chi_minus_one) {
    Orders& c = cosine_[0][0];
    const double total = a + b;
    const EllipticIntegrals elliptic = elliptic_integrals(a / total);
    const double scale = 4.0 / std::sqrt(total);
    const double chi = 1.0 + chi_minus_one;
    c[0] = scale * elliptic.k;
    const double decay = std::log1p(chi_minus_one + std::sqrt(chi_minus_one * (2.0 + chi_minus_one)));  // acosh(chi)
    if (2.0 * decay * static_cast<double>(count_) < 3.0) {
        c[1] = c[0] - 2.0 * scale * elliptic.b;
        for (std::size_t k = 1; k + 1 < count_; ++k) {
            const double order = static_cast<double>(k);
            c[k + 1] = (2.0 * order * chi * c[k] - (order - 0.5) * c[k - 1]) / (order + 0.5);
        }
        return;
    }
    const std::size_t start = count_ + static_cast<std::size_t>(0.5 * digits / decay) + 2;
    double above = 0.0, value = 1e-200;
    for (std::size_t k = start; k > 0; --k) {
        const double order = static_cast<double>(k);
        const double below = (2.0 * order * chi * value - (order + 0.5) * above) / (order - 0.5);
        if (k < count_) c[k] = value;
        above = value;
        value = below;
    }
    const double correction = c[0] / value;
    for (std::size_t k = 1; k < count_; ++k) c[k] *= correction;
}

void AzimuthalIntegrals::by_recurrence(double a, double b) {
    const double half_b = 0.5 * b;
    const double chi_minus_one = a / half_b;
    const double chi = 1.0 + chi_minus_one;
    toroidal_harmonics(a, b, chi_minus_one);
    const double inverse = 1.0 / (chi_minus_one * (chi + 1.0) * half_b);
    for (std::size_t p = 1; p < powers; ++p) {
        const double nu = static_cast<double>(p) - 0.5;
        const Orders& from = cosine_[p - 1][0];
        for (std::size_t k = 0; k + p < count_; ++k) {
            const double order = static_cast<double>(k);
            cosine_[p][0][k] =
                inverse * (chi * (1.0 + order / nu) * from[k] - ((order + 1.0) / nu - 1.0) * from[k + 1]);
            sine_[p][0][k] = order / nu / half_b * from[k];
        }
    }
    // p = 1: by differences, of which the first loses only the size of a logarithm. p > 1: b sigma = rho^2 - a.
    for (std::size_t k = 0; k <= highest_; ++k) {
        const Orders& c = cosine_[0][0];
        const double below = c[k == 0 ? 1 : k - 1];
        cosine_[0][1][k] = 0.5 * c[k] - 0.25 * (below + c[k + 1]);
        sine_[0][0][k] = 0.5 * (below - c[k + 1]);
        for (std::size_t p = 1; p < powers; ++p) {
            for (std::size_t j = 0; j <= p; ++j) {
                cosine_[p][j + 1][k] = (cosine_[p - 1][j][k] - a * cosine_[p][j][k]) / b;
            }
            for (std::size_t j = 0; j < p; ++j) {
                sine_[p][j + 1][k] = (sine_[p - 1][j][k] - a * sine_[p][j][k]) / b;
            }
        }
    }
    sine_[0][0][0] = 0.0;
}

}  // namespace endoflow::boundary_integral
