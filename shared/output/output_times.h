#pragma once

#include <cmath>
#include <limits>

namespace endoflow {

/// Relative difference of times that is round-off.
inline constexpr double same_time = 1e-12;

/// The first multiple of an interval [µs] after a time; never when the interval is 0.
inline double next_multiple(double interval, double time) {
    if (interval <= 0) return std::numeric_limits<double>::infinity();
    return (std::floor(time / interval * (1 + same_time)) + 1) * interval;
}

}  // namespace endoflow
