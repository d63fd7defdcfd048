#include "statics/vesicle_case.h"

#include <cmath>

#include "shared/geometry/spheroid.h"
#include "shared/model/initial_condition.h"
#include "shared/support/error.h"

namespace endoflow::statics {

namespace {

/// Whether membranes of two concentrations bend alike, but for round-off: at rest and on the sphere of their area.
bool alike(const ClosedMembrane& membrane, const ClosedMembrane& other) {
    const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b)); };
    const double on_sphere = 2 * other.stiffness() / other.sphere_radius();
    return close(membrane.stiffness(), other.stiffness()) &&
           close(membrane.spontaneous_curvature, other.spontaneous_curvature) &&
           close(membrane.elastic(0, on_sphere).curvature, other.elastic(0, on_sphere).curvature);
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
    const auto membrane_at = [&](double arc_length) {
        return ClosedMembrane(membrane_energy(parameters), initial_concentration(parameters.molecules, arc_length),
                              spheroid.area(), spheroid.volume());
    };
    const ClosedMembrane south = membrane_at(spheroid.length());
    if (!alike(membrane_at(0), south))
        throw InputError(
            "molecules.patch_radius covers a part of the vesicle: its stationary shapes are computed for an even "
            "membrane "
            "only; make it 1e4 (coated everywhere), or membrane.bending_stiffness_coated = membrane.bending_stiffness "
            "and "
            "membrane.spontaneous_curvature = 0");
    return {south, spheroid.polar > spheroid.equator ? VesicleFamily::prolate : VesicleFamily::oblate};
}

}  // namespace endoflow::statics
