#include "boundary_integral/evolution/initial_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boundary_integral/quadrature/gauss_legendre.h"
#include "shared/model/initial_condition.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int pieces = 64;

template <class Function>
double integral(double begin, double end, const Function& function) {
    static const QuadratureRule rule = gauss_legendre(8);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        sum += 0.5 * (end - begin) * rule.weights[i] * function(0.5 * (begin + end + (end - begin) * rule.nodes[i]));
    }
    return sum;
}

}  // namespace

InitialCurve::InitialCurve(const Parameters& parameters) : parameters_(parameters), arc_length_{0.0} {
    for (int i = 0; i < pieces && closed(); ++i) {
        const double begin = static_cast<double>(i) / pieces, end = static_cast<double>(i + 1) / pieces;
        arc_length_.push_back(arc_length_.back() + integral(begin, end, [this](double s) { return speed(s); }));
    }
}

double InitialCurve::radius(double s) const {
    return closed() ? parameters_.domain.spheroid_equatorial_axis * std::sin(pi * s) : parameters_.domain.radius * s;
}

double InitialCurve::height(double s) const {
    const double centre = parameters_.domain.membrane_height;
    return closed() ? centre + parameters_.domain.spheroid_polar_axis * std::cos(pi * s) : centre;
}

double InitialCurve::speed(double s) const {
    return pi * std::hypot(parameters_.domain.spheroid_equatorial_axis * std::cos(pi * s),
                           parameters_.domain.spheroid_polar_axis * std::sin(pi * s));
}

double InitialCurve::distance(double s) const {
    const int piece = std::clamp(static_cast<int>(s * pieces), 0, pieces - 1);
    return arc_length_[static_cast<std::size_t>(piece)] +
           integral(static_cast<double>(piece) / pieces, s, [this](double t) { return speed(t); });
}

double InitialCurve::concentration(double s) const {
    return initial_concentration(parameters_.molecules, closed() ? distance(s) : radius(s));
}

}  // namespace endoflow::boundary_integral
