#include "phasefield/driver/clearance.h"

#include "shared/geometry/wall_distance.h"

namespace endoflow::phasefield {

void require_clearance(const MembraneCurve& curve, const Parameters& p, double time) {
    WallDistance walls(p.domain);
    for (std::size_t i = 0; i < curve.size(); ++i) walls.look_at(curve.r[i], curve.z[i], curve.s.back() - curve.s[i]);
    walls.require_clearance(time);
}

}  // namespace endoflow::phasefield
