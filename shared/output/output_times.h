#pragma once

#include <algorithm>
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

/// So many shapes stand before the first interval, each at twice the time of the one before: the membrane is fastest
/// at the start.
inline constexpr int early_shapes = 8;

/// When the next membrane shape after a time [µs] is due, in all engines alike: interval/2⁸, …, interval/4, interval/2,
/// then its multiples.
inline double next_shape_time(double interval, double time) {
    for (double early = std::ldexp(interval, -early_shapes); early < interval; early *= 2)
        if (early > time * (1 + same_time)) return early;
    return next_multiple(interval, time);
}

/// The time between checkpoints [s] where one costs `cost`: the wanted `interval`, less (but two seconds) while they
/// cost below 1 % of the time, so that a kill costs seconds, and more where they would cost above 2 % of it. With an
/// interval of 0 there is one after every step.
inline double checkpoint_pause(double interval, double cost) {
    constexpr double shortest = 2, cheap = 0.01, most = 0.02;
    return interval == 0 ? 0 : std::max(std::min(interval, std::max(shortest, cost / cheap)), cost / most);
}

}  // namespace endoflow
