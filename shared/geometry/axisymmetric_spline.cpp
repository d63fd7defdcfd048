#include "shared/geometry/axisymmetric_spline.h"

namespace endoflow {

AxisymmetricSpline::AxisymmetricSpline(const std::vector<double>& t, const std::vector<double>& values, Parity parity)
    : spline_(gsl_spline_alloc(gsl_interp_cspline, 2 * t.size() - 1), &gsl_spline_free) {
    const std::size_t n = t.size();
    const double sign = parity == Parity::even ? 1 : -1;
    std::vector<double> mirrored_t(2 * n - 1), mirrored_values(2 * n - 1);
    for (std::size_t i = 0; i < n; ++i) {
        mirrored_t[n - 1 - i] = -t[i];
        mirrored_values[n - 1 - i] = sign * values[i];
        mirrored_t[n - 1 + i] = t[i];
        mirrored_values[n - 1 + i] = values[i];
    }
    gsl_spline_init(spline_.get(), mirrored_t.data(), mirrored_values.data(), 2 * n - 1);
}

}  // namespace endoflow
