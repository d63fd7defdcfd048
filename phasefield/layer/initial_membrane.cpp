#include "phasefield/layer/initial_membrane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace endoflow::phasefield {

InitialMembrane::InitialMembrane(const Parameters& p)
    : domain_(p.domain), spheroid_(initial_spheroid(p.domain)), curve_(p) {}

InitialPoint InitialMembrane::at(double r, double z) const {
    const double above = z - domain_.membrane_height;
    if (domain_.kind == DomainKind::box) return {-above, 0, curve_.concentration(r / domain_.radius)};
    const double t = spheroid_.closest(r, above), to_r = r - spheroid_.radius(t), to_z = above - spheroid_.height(t);
    const double relative_r = r / spheroid_.equator, relative_z = above / spheroid_.polar;
    const double inside = relative_r * relative_r + relative_z * relative_z < 1 ? 1 : -1;
    return {inside * std::hypot(to_r, to_z), spheroid_.curvature(t), curve_.concentration(t / std::numbers::pi)};
}

MembraneCurve InitialMembrane::curve(double spacing) const {
    const double longest = domain_.kind == DomainKind::box
                               ? domain_.radius
                               : std::numbers::pi * std::max(spheroid_.equator, spheroid_.polar);
    // Where it divides, round-off does not add a point: the mesh is one for a problem in whatever units.
    const int intervals = std::max(8, static_cast<int>(std::ceil(longest / spacing * (1 - 1e-9))));
    MembraneCurve out;
    for (int i = 0; i <= intervals; ++i) {
        const double s = static_cast<double>(i) / intervals;
        out.r.push_back(domain_.kind == DomainKind::free_space && i == intervals ? 0 : curve_.radius(s));
        out.z.push_back(curve_.height(s));
        out.c.push_back(curve_.concentration(s));
    }
    return out;
}

}  // namespace endoflow::phasefield
