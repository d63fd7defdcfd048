#include "phasefield/contour/material_force.h"

#include <cmath>
#include <numbers>

#include "phasefield/contour/polyline.h"

namespace endoflow::phasefield {

MaterialForce::MaterialForce(const MembraneCurve& membrane, const Loads& loads)
    : loads_(loads), r_(membrane.r), z_(membrane.z) {
    area_.assign(r_.size(), 0);
    for (std::size_t i = 1; i < r_.size(); ++i)
        area_[i] =
            area_[i - 1] + std::numbers::pi * (r_[i] + r_[i - 1]) * std::hypot(r_[i] - r_[i - 1], z_[i] - z_[i - 1]);
}

double MaterialForce::at(double r, double z) const {
    return loads_.material_force(at_closest_point(r_, z_, area_, r, z));
}

}  // namespace endoflow::phasefield
