#include "shared/geometry/observables.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "shared/geometry/axisymmetric_spline.h"
#include "shared/model/bending_term.h"

namespace endoflow {

namespace {

using Quadrature = boost::math::quadrature::gauss<double, 7>;

void require_valid(const MembraneCurve& curve) {
    const std::size_t n = curve.size();
    if (n < 4 || curve.z.size() != n) throw std::invalid_argument("a membrane curve needs at least 4 points");
    if (std::abs(curve.r.front()) > 1e-6 * *std::max_element(curve.r.begin(), curve.r.end()))
        throw std::invalid_argument("a membrane curve must start on the axis");
    for (std::size_t i = 1; i < n; ++i)
        if (curve.r[i] == curve.r[i - 1] && curve.z[i] == curve.z[i - 1])
            throw std::invalid_argument("a membrane curve must not repeat a point");
}

struct Shape : Meridian {
    std::vector<double> t;
    FarEnd end;
    AxisymmetricSpline r, z;

    explicit Shape(const MembraneCurve& curve)
        : t(chord_length(curve.r, curve.z)),
          end(curve.closed() ? FarEnd::axis : FarEnd::free),
          r(t, curve.r, Parity::odd, end),
          z(t, curve.z, Parity::even, end) {}

    /// ∫ f(t) dt, 7-point Gauss on every interval between samples: the splines are polynomials there.
    template <class Integrand>
    double integrate(const Integrand& f) const {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < t.size(); ++i) sum += Quadrature::integrate(f, t[i], t[i + 1]);
        return sum;
    }

    [[nodiscard]] const std::vector<double>& knots() const override { return t; }
    [[nodiscard]] double radius(double at) const override { return r.value(at); }
    [[nodiscard]] double slope(double at) const override { return r.derivative(at); }

    double metric(double at) const { return std::hypot(r.derivative(at), z.derivative(at)); }
};

/// The largest value of sign × f, also between samples. f' is a quadratic polynomial there, whose roots are looked at
/// without asking for signs of f' at the samples: on the axis f' is zero, with the sign of its round-off.
double largest(const AxisymmetricSpline& f, const std::vector<double>& t, double sign = 1) {
    double best = sign * f.value(t.back());
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
        best = std::max(best, sign * f.value(t[i]));
        const double width = t[i + 1] - t[i], slope = sign * f.derivative(t[i]),
                     bend = sign * f.second_derivative(t[i]);
        const double bend_change = (sign * f.second_derivative(t[i + 1]) - bend) / width;
        // f' = slope + bend x + ½ bend_change x² falls through zero at the root with f'' = −√discriminant.
        const double discriminant = bend * bend - 2 * bend_change * slope;
        if (discriminant <= 0) continue;
        const double root = std::sqrt(discriminant);
        const double x = bend < 0 ? 2 * slope / (root - bend) : -(bend + root) / bend_change;
        if (x > 0 && x < width) best = std::max(best, sign * f.value(t[i] + x));
    }
    return best;
}

}  // namespace

double bud_height_between(double highest, double lowest, double rim, bool closed) {
    if (closed) return highest - lowest;
    return highest - rim >= rim - lowest ? highest - rim : lowest - rim;
}

Observables measure(const MembraneCurve& curve, const BendingModel& model) {
    require_valid(curve);
    const Shape shape(curve);
    const AxisymmetricSpline c(shape.t, curve.c, Parity::even, shape.end),
        kappa(shape.t, curve.kappa, Parity::even, shape.end);
    const double z_rim = curve.z.back(), two_pi = 2 * std::numbers::pi;
    const auto area_element = [&](double t) { return two_pi * shape.r.value(t) * shape.metric(t); };

    const BendingTerm bending{model};
    Observables result;
    result.neck = find_neck(shape);
    result.bud_height =
        bud_height_between(largest(shape.z, shape.t), -largest(shape.z, shape.t, -1), z_rim, curve.closed());
    result.membrane_area = shape.integrate(area_element);
    result.molecule_mass = shape.integrate([&](double t) { return c.value(t) * area_element(t); });
    result.bending_energy = shape.integrate([&](double t) {
        return bending.density(LocalShape<double>{kappa.value(t), c.value(t), 0}) * area_element(t);
    });
    result.extracellular_volume = shape.integrate(
        [&](double t) { return (shape.z.value(t) - z_rim) * two_pi * shape.r.value(t) * shape.r.derivative(t); });
    return result;
}

}  // namespace endoflow
