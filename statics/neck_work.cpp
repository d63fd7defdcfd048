#include "statics/neck_work.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace endoflow::statics {

namespace {

/// A cubic on [0, 1] with values and slopes at its ends.
struct Cubic {
    double first, last, first_slope, last_slope;

    [[nodiscard]] double value(double u) const {
        const double v = 1 - u;
        return v * v * (1 + 2 * u) * first + u * u * (1 + 2 * v) * last + u * v * (v * first_slope - u * last_slope);
    }
    [[nodiscard]] double slope(double u) const {
        const double v = 1 - u;
        return 6 * u * v * (last - first) + v * (v - 2 * u) * first_slope + u * (u - 2 * v) * last_slope;
    }
};

}  // namespace

double NeckWork::to(const HeldState& next) {
    const PiecewiseSolution& tangent = next.point.tangent;
    const Point here{next.held.radius, next.force(), tangent.parameter, tangent.globals(held_global::force)};
    if (!last_) {
        least_radius_ = barrier_.from_radius = barrier_.to_radius = here.radius;
        least_force_ = here.force;
        last_ = here;
        return 0;
    }
    // The rates as slopes by u: the chord over their mean length, in units in which both have the same.
    const double radius_unit = std::max(std::abs(last_->radius_rate), std::abs(here.radius_rate)),
                 force_unit = std::max(std::abs(last_->force_rate), std::abs(here.force_rate));
    const auto length = [&](double radius, double force) {
        return std::hypot(radius / radius_unit, force / force_unit);
    };
    const double chord = length(here.radius - last_->radius, here.force - last_->force),
                 mean =
                     0.5 * (length(last_->radius_rate, last_->force_rate) + length(here.radius_rate, here.force_rate)),
                 step = chord / mean;
    const Cubic radius{last_->radius, here.radius, step * last_->radius_rate, step * here.radius_rate},
        force{last_->force, here.force, step * last_->force_rate, step * here.force_rate};
    const auto work_within = [&](double end) {  // five points are exact for a polynomial of this degree
        const auto power = [&](double u) { return force.value(u) * radius.slope(u); };
        return boost::math::quadrature::gauss<double, 5>::integrate(power, 0.0, end);
    };
    if (last_->force * here.force < 0) {  // the work has an extremum on the way
        std::uintmax_t evaluations = 60;
        const auto zero =
            boost::math::tools::toms748_solve([&](double u) { return force.value(u); }, 0.0, 1.0, last_->force,
                                              here.force, boost::math::tools::eps_tolerance<double>(40), evaluations);
        pass(work_ + work_within(zero.first), radius.value(zero.first));
    }
    work_ += work_within(1);
    pass(work_, here.radius);
    least_force_ = std::min(least_force_, here.force);
    last_ = here;
    return work_;
}

void NeckWork::pass(double work, double radius) {
    const double distance = std::abs(radius - end_);
    if (distance > nearest_) return;
    nearest_ = distance;
    if (work < least_work_) {
        least_work_ = work;
        least_radius_ = radius;
    }
    if (work - least_work_ > barrier_.height) barrier_ = {work - least_work_, least_radius_, radius};
}

}  // namespace endoflow::statics
