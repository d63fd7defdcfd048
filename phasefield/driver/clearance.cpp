#include "phasefield/driver/clearance.h"

#include <fmt/format.h>

#include <algorithm>

#include "phasefield/fem/flow_domain.h"
#include "shared/geometry/wall_distance.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// Of a vesicle, which has no rim.
void require_free_space(const MembraneCurve& curve, const Parameters& p, double time) {
    const FlowDomain box = flow_domain(p);
    double smallest = box.radius;
    for (std::size_t i = 0; i < curve.size(); ++i)
        smallest = std::min({smallest, box.radius - curve.r[i], curve.z[i] - box.bottom, box.top - curve.z[i]});
    if (smallest >= p.domain.wall_clearance) return;
    throw SolverError("membrane-near-wall",
                      fmt::format("at t = {:.6f} µs the vesicle is {:.6f} nm from the walls, nearer than "
                                  "domain.wall_clearance",
                                  time, smallest),
                      "enlarge phase_field.free_space");
}

}  // namespace

void require_clearance(const MembraneCurve& curve, const Parameters& p, double time) {
    if (curve.closed()) {
        require_free_space(curve, p, time);
        return;
    }
    WallDistance walls(p.domain);
    for (std::size_t i = 0; i < curve.size(); ++i) walls.look_at(curve.r[i], curve.z[i], curve.s.back() - curve.s[i]);
    walls.require_clearance(time);
}

}  // namespace endoflow::phasefield
