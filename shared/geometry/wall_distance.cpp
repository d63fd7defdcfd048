#include "shared/geometry/wall_distance.h"

#include <fmt/format.h>

#include <algorithm>

#include "shared/support/error.h"

namespace endoflow {

void WallDistance::look_at(const char* wall, double distance, double r, double z) {
    if (distance >= smallest_) return;
    smallest_ = distance;
    wall_ = wall;
    r_ = r;
    z_ = z;
}

void WallDistance::look_at(double r, double z, double to_rim) {
    look_at("bottom", z, r, z);
    look_at("top", domain_.height - z, r, z);
    const double rim = std::max(4 * domain_.wall_clearance, domain_.pin_half_width);
    if (to_rim > rim) look_at("side wall", domain_.radius - r, r, z);
}

void WallDistance::require_clearance(double time) const {
    if (smallest_ >= domain_.wall_clearance) return;
    throw SolverError("membrane-near-wall",
                      fmt::format("at t = {:.6f} µs the membrane is {:.6f} nm from the {} at r = {:.6f} nm, z = {:.6f} "
                                  "nm, nearer than domain.wall_clearance",
                                  time, smallest_, wall_, r_, z_),
                      "enlarge domain.radius or domain.height, or move domain.membrane_height");
}

}  // namespace endoflow
