#include "shared/output/output_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/model/time_scale.h"

namespace endoflow {

namespace {

constexpr int early_shapes = 8;  // each at twice the time of the one before

/// The longest chosen interval, at the run's end, is this part of the run before it becomes a power of two. 393 to 426
/// shapes follow for all ends beyond a thousand first steps: the power of two is what they differ by.
constexpr double last_part = 1.0 / 140;

/// The power of two [µs] that is not longer.
double power_of_two(double interval) {
    return std::exp2(std::floor(std::log2(interval)));
}

}  // namespace

double next_multiple(double interval, double time) {
    if (interval <= 0) return std::numeric_limits<double>::infinity();
    return (std::floor(time / interval * (1 + same_time)) + 1) * interval;
}

ShapeTimes::ShapeTimes(const Parameters& parameters)
    : interval(parameters.output.shape_interval), end(parameters.time.end), first(first_step(parameters)) {}

double ShapeTimes::after(double time) const {
    if (interval <= 0) return chosen_after(time);
    for (double early = std::ldexp(interval, -early_shapes); early < interval; early *= 2)
        if (later(early, time)) return early;
    return next_multiple(interval, time);
}

double ShapeTimes::chosen_interval(double time) const {
    return std::max(power_of_two(first), power_of_two(std::min(time, last_part * std::sqrt(time * end))));
}

double ShapeTimes::chosen_after(double time) const {
    double due = next_multiple(chosen_interval(time), time);
    while (true) {  // where the interval grows in between, to a multiple of the longer one
        const double own = chosen_interval(due), multiple = std::ceil(due / own) * own;
        if (multiple == due) return due;
        due = multiple;
    }
}

double checkpoint_pause(double interval, double cost) {
    constexpr double shortest = 2, cheap = 0.01, most = 0.02;
    return interval == 0 ? 0 : std::max(std::min(interval, std::max(shortest, cost / cheap)), cost / most);
}

}  // namespace endoflow
