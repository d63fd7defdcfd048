#include "shared/geometry/axisymmetric_spline.h"

#include <cmath>

namespace endoflow {

std::vector<double> chord_length(const std::vector<double>& r, const std::vector<double>& z) {
    std::vector<double> t(r.size(), 0);
    for (std::size_t i = 1; i < r.size(); ++i) t[i] = t[i - 1] + std::hypot(r[i] - r[i - 1], z[i] - z[i - 1]);
    return t;
}

namespace {

constexpr std::size_t mirrored_points(std::size_t n, FarEnd end) {
    return end == FarEnd::axis ? 3 * n - 2 : 2 * n - 1;
}

}  // namespace

AxisymmetricSpline::AxisymmetricSpline(const std::vector<double>& t, const std::vector<double>& values, Parity parity,
                                       FarEnd end)
    : spline_(gsl_spline_alloc(gsl_interp_cspline, mirrored_points(t.size(), end)), &gsl_spline_free) {
    const std::size_t n = t.size(), size = mirrored_points(n, end);
    const double sign = parity == Parity::even ? 1 : -1;
    std::vector<double> mirrored_t(size), mirrored_values(size);
    for (std::size_t i = 0; i < n; ++i) {
        mirrored_t[n - 1 - i] = -t[i];
        mirrored_values[n - 1 - i] = sign * values[i];
        mirrored_t[n - 1 + i] = t[i];
        mirrored_values[n - 1 + i] = values[i];
    }
    for (std::size_t i = 2 * n - 1; i < size; ++i) {  // of the point as far before the end
        const std::size_t before = 3 * n - 3 - i;
        mirrored_t[i] = 2 * t.back() - t[before];
        mirrored_values[i] = sign * values[before];
    }
    gsl_spline_init(spline_.get(), mirrored_t.data(), mirrored_values.data(), size);
}

}  // namespace endoflow
