#include "shared/geometry/meridian.h"

#include <algorithm>
#include <limits>

#include "shared/numerics/root.h"

namespace endoflow {

namespace {

/// Where r' changes its sign between two parameters.
double stationary_point(const Meridian& meridian, double lower, double upper) {
    constexpr int bits = 48;
    return root_between([&](double t) { return meridian.slope(t); }, lower, upper, bits);
}

}  // namespace

std::optional<Neck> find_neck(const Meridian& meridian) {
    const std::vector<double>& knots = meridian.knots();
    std::optional<Neck> neck;
    double widest = 0, before = meridian.slope(knots.front());
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const double after = meridian.slope(knots[i]);
        if (before > 0 && after <= 0) {
            widest = std::max(widest, meridian.radius(stationary_point(meridian, knots[i - 1], knots[i])));
        } else if (before < 0 && after >= 0) {
            const double t = stationary_point(meridian, knots[i - 1], knots[i]);
            const double radius = meridian.radius(t);
            if (!neck || radius < neck->radius) neck = Neck{radius, 2 * widest, t};
        }
        before = after;
    }
    return neck;
}

double neck_radius(const std::optional<Neck>& neck) {
    return neck ? neck->radius : std::numeric_limits<double>::infinity();
}

}  // namespace endoflow
