#include "shared/output/output_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace endoflow {

namespace {

constexpr int early_shapes = 8;  // each at twice the time of the one before

}  // namespace

double next_multiple(double interval, double time) {
    if (interval <= 0) return std::numeric_limits<double>::infinity();
    return (std::floor(time / interval * (1 + same_time)) + 1) * interval;
}

double next_shape_time(double interval, double time) {
    for (double early = std::ldexp(interval, -early_shapes); early < interval; early *= 2)
        if (later(early, time)) return early;
    return next_multiple(interval, time);
}

double checkpoint_pause(double interval, double cost) {
    constexpr double shortest = 2, cheap = 0.01, most = 0.02;
    return interval == 0 ? 0 : std::max(std::min(interval, std::max(shortest, cost / cheap)), cost / most);
}

}  // namespace endoflow
