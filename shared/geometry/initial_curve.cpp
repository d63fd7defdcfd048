#include "shared/geometry/initial_curve.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "shared/model/initial_condition.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

using std::numbers::pi;
constexpr int pieces = 64;

/// Along the meridian between two parameters s, nm.
double arc(const Spheroid& spheroid, double begin, double end) {
    const auto metric = [&](double t) { return spheroid.metric(t); };
    return boost::math::quadrature::gauss<double, 10>::integrate(metric, pi * begin, pi * end);
}

}  // namespace

Spheroid initial_spheroid(const DomainParameters& domain) {
    return {domain.spheroid_equatorial_axis, domain.spheroid_polar_axis};
}

void require_deformable(const Parameters& p) {
    if (p.domain.kind != DomainKind::free_space || p.fluid.dynamics != Dynamics::flow || !p.membrane.inextensible)
        return;
    if (p.domain.spheroid_polar_axis == p.domain.spheroid_equatorial_axis)
        throw InputError(
            "domain.spheroid_polar_axis: an inextensible sphere keeps its shape; make it differ from "
            "domain.spheroid_equatorial_axis");
}

InitialCurve::InitialCurve(const Parameters& parameters)
    : parameters_(parameters), spheroid_(initial_spheroid(parameters.domain)), arc_length_{0.0} {
    for (int i = 0; i < pieces && closed(); ++i)
        arc_length_.push_back(arc_length_.back() +
                              arc(spheroid_, static_cast<double>(i) / pieces, static_cast<double>(i + 1) / pieces));
}

double InitialCurve::radius(double s) const {
    return closed() ? spheroid_.radius(pi * s) : parameters_.domain.radius * s;
}

double InitialCurve::height(double s) const {
    const double centre = parameters_.domain.membrane_height;
    return closed() ? centre + spheroid_.height(pi * s) : centre;
}

double InitialCurve::distance(double s) const {
    const int piece = std::clamp(static_cast<int>(s * pieces), 0, pieces - 1);
    const double begin = static_cast<double>(piece) / pieces;
    return arc_length_[static_cast<std::size_t>(piece)] + (s > begin ? arc(spheroid_, begin, s) : 0);
}

double InitialCurve::concentration(double s) const {
    return initial_concentration(parameters_.molecules, closed() ? distance(s) : radius(s));
}

}  // namespace endoflow
