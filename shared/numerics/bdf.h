#pragma once

#include <cstddef>
#include <vector>

#include "shared/numerics/lagrange.h"

namespace endoflow {

/// Backward differentiation on uneven steps. Past times come newest first.

/// dy/dt at `time` ≈ rate y(time) + Σ_j past[j] y(times[j]), exact for polynomials of degree `order`. [1/µs]
struct BdfCoefficients {
    double rate;
    std::vector<double> past;
};

inline BdfCoefficients bdf_coefficients(double time, const std::vector<double>& times, std::size_t order) {
    BdfCoefficients out{0, std::vector<double>(order, 0.0)};
    for (std::size_t j = 0; j < order; ++j) {
        out.rate += 1 / (time - times[j]);
        double weight = 1 / (times[j] - time);
        for (std::size_t m = 0; m < order; ++m)
            if (m != j) weight *= (time - times[m]) / (times[j] - times[m]);
        out.past[j] = weight;
    }
    return out;
}

/// Weights of the values at times[0 … count) in the polynomial through them, at `time`.
inline std::vector<double> extrapolation_weights(double time, const std::vector<double>& times, std::size_t count) {
    return lagrange_weights({times.begin(), times.begin() + static_cast<std::ptrdiff_t>(count)}, time);
}

/// Error of the BDF solution as part of its difference to the predictor through order + 1 past values:
/// (1/a₀) / (1/a₀ + t − t_{order}), a₀ the rate; 2/11 for equal steps and order two.
inline double error_fraction(double time, const std::vector<double>& times, std::size_t order) {
    const double lag = 1 / bdf_coefficients(time, times, order).rate;
    return lag / (lag + time - times[order]);
}

}  // namespace endoflow
