#include "shared/geometry/spheroid.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "shared/numerics/root.h"

namespace endoflow {

namespace {

using std::numbers::pi;

template <class Function>
double integral(const Function& function, double end) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(function, 0.0, end, 8, 1e-13);
}

}  // namespace

double Spheroid::radius(double t) const {
    return equator * std::sin(t);
}

double Spheroid::height(double t) const {
    return polar * std::cos(t);
}

double Spheroid::metric(double t) const {
    return std::hypot(equator * std::cos(t), polar * std::sin(t));
}

double Spheroid::curvature(double t) const {
    const double g = metric(t);
    return equator * polar / (g * g * g) + polar / (equator * g);
}

double Spheroid::label(double t) const {
    return integral([this](double u) { return equator * std::sin(u) * metric(u); }, t);
}

double Spheroid::parameter_of(double label_fraction) const {
    if (label_fraction <= 0) return 0;
    if (label_fraction >= 1) return pi;
    const double whole = label(pi), wanted = label_fraction * whole;
    constexpr int bits = 45;
    return root_between([&](double t) { return label(t) - wanted; }, 0.0, pi, -wanted, whole - wanted, bits);
}

double Spheroid::closest(double r, double z) const {
    // In the quarter plane of the point one of its normals is the shortest; on the axis and in the plane of the equator
    // a point beside it tells which.
    const double beside = std::max(r, 1e-12 * equator), above = std::max(std::abs(z), 1e-12 * polar);
    const auto slope = [&](double t) {  // of half the squared distance
        return (radius(t) - beside) * equator * std::cos(t) - (height(t) - above) * polar * std::sin(t);
    };
    constexpr int bits = 50;
    const double t = root_between(slope, 0.0, pi / 2, bits);
    return z < 0 ? pi - t : t;
}

double Spheroid::area() const {
    return 2 * pi * label(pi);
}

double Spheroid::volume() const {
    return 4 * pi / 3 * equator * equator * polar;
}

double Spheroid::length() const {
    return integral([this](double u) { return metric(u); }, pi);
}

}  // namespace endoflow
