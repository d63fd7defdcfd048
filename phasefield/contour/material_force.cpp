#include "phasefield/contour/material_force.h"

#include <cmath>
#include <numbers>

#include "phasefield/contour/polyline.h"

namespace endoflow::phasefield {

std::vector<double> area_from_pole(const MembraneCurve& membrane) {
    const std::vector<double>&r = membrane.r, &z = membrane.z;
    std::vector<double> area(r.size(), 0);
    for (std::size_t i = 1; i < r.size(); ++i)
        area[i] = area[i - 1] + std::numbers::pi * (r[i] + r[i - 1]) * std::hypot(r[i] - r[i - 1], z[i] - z[i - 1]);
    return area;
}

MaterialForce::MaterialForce(const MembraneCurve& membrane, const Loads& loads)
    : loads_(loads), r_(membrane.r), z_(membrane.z) {
    area_ = area_from_pole(membrane);
}

ForceDensity MaterialForce::at(double r, double z) const {
    const double a = at_closest_point(r_, z_, area_, r, z);
    return {loads_.radial_force(a), loads_.material_force(a)};
}

}  // namespace endoflow::phasefield
