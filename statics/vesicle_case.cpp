#include "statics/vesicle_case.h"

#include <cmath>
#include <numbers>

#include "shared/geometry/spheroid.h"
#include "shared/model/bending_model.h"
#include "shared/model/initial_condition.h"
#include "shared/support/error.h"

namespace endoflow::statics {

namespace {

/// Whether the membrane bends alike at both concentrations, but for round-off.
bool alike(const BendingModel& bending, double c, double other) {
    const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b)); };
    return close(bending.stiffness(c).value, bending.stiffness(other).value) &&
           close(bending.spontaneous_curvature(c).value, bending.spontaneous_curvature(other).value);
}

}  // namespace

VesicleCase vesicle_case(const Parameters& parameters) {
    const auto& domain = parameters.domain;
    const Spheroid spheroid{domain.spheroid_equatorial_axis, domain.spheroid_polar_axis};
    if (spheroid.equator == spheroid.polar)
        throw InputError(
            "domain.spheroid_polar_axis equals domain.spheroid_equatorial_axis: a sphere has no other shape of its "
            "area "
            "and volume; make one of them longer");
    const BendingModel bending(parameters.membrane);
    const double north = initial_concentration(parameters.molecules, 0);
    const double south = initial_concentration(parameters.molecules, spheroid.length());
    if (!alike(bending, north, south))
        throw InputError(
            "molecules.patch_radius covers a part of the vesicle: its stationary shapes are computed for an even "
            "membrane "
            "only; make it 1e4 (coated everywhere), or membrane.bending_stiffness_coated = membrane.bending_stiffness "
            "and "
            "membrane.spontaneous_curvature = 0");
    return {{bending.stiffness(south).value, bending.spontaneous_curvature(south).value, spheroid.area(),
             spheroid.volume()},
            spheroid.polar > spheroid.equator ? VesicleFamily::prolate : VesicleFamily::oblate,
            south};
}

}  // namespace endoflow::statics
