#include "phasefield/driver/clearance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "shared/support/error.h"

namespace endoflow::phasefield {

void require_clearance(const MembraneCurve& curve, const Parameters& p, double time) {
    const double clearance = p.domain.wall_clearance;
    const auto near = [&](const char* wall, double distance, std::size_t i) {
        if (distance >= clearance) return;
        throw SolverError("membrane-near-wall",
                          "at t = " + std::to_string(time) + " µs the membrane is " + std::to_string(distance) +
                              " nm from the " + wall + " at r = " + std::to_string(curve.r[i]) +
                              " nm, z = " + std::to_string(curve.z[i]) + " nm",
                          "use a larger domain or another domain.membrane_height");
    };
    // The rim ends on the side wall; only what bends back towards it counts.
    const double rim_arc = curve.s.empty() ? 0 : curve.s.back() - std::max(4 * clearance, p.domain.pin_half_width);
    for (std::size_t i = 0; i < curve.size(); ++i) {
        near("bottom", curve.z[i], i);
        near("top", p.domain.height - curve.z[i], i);
        if (curve.s[i] < rim_arc) near("side wall", p.domain.radius - curve.r[i], i);
    }
}

}  // namespace endoflow::phasefield
