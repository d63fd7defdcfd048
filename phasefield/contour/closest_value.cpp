#include "phasefield/contour/closest_value.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "phasefield/contour/polyline.h"

namespace endoflow::phasefield {

namespace {

constexpr int newton_steps = 4;  // from the polyline's closest point: to round-off where curvature is resolved

}  // namespace

ClosestValue::ClosestValue(std::vector<double> r, std::vector<double> z, const std::vector<double>& values)
    : r_(std::move(r)),
      z_(std::move(z)),
      t_(chord_length(r_, z_)),
      end_(r_.back() < 0.5 * *std::max_element(r_.begin(), r_.end()) ? FarEnd::axis : FarEnd::free),
      spline_r_(t_, r_, Parity::odd, end_),
      spline_z_(t_, z_, Parity::even, end_),
      values_(t_, values, Parity::even, end_) {}

double ClosestValue::at(double r, double z) const {
    const double nearest = at_closest_point(r_, z_, t_, r, z);
    const auto after = std::upper_bound(t_.begin() + 1, t_.end() - 1, nearest) - t_.begin();
    const auto i = static_cast<std::size_t>(after);
    const double first = t_[i < 2 ? 0 : i - 2], last = t_[std::min(i + 1, t_.size() - 1)];
    double t = nearest;
    for (int k = 0; k < newton_steps; ++k) {
        const double to_r = spline_r_.value(t) - r, to_z = spline_z_.value(t) - z;
        const double r1 = spline_r_.derivative(t), z1 = spline_z_.derivative(t);
        const double slope =
            r1 * r1 + z1 * z1 + to_r * spline_r_.second_derivative(t) + to_z * spline_z_.second_derivative(t);
        if (slope <= 0) return values_.value(nearest);  // beyond the centre of curvature: any is as close
        t = std::clamp(t - (to_r * r1 + to_z * z1) / slope, first, last);
    }
    return values_.value(t);
}

}  // namespace endoflow::phasefield
