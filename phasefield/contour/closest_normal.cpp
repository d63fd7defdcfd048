#include "phasefield/contour/closest_normal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace endoflow::phasefield {

namespace {

double cross(double a_r, double a_z, double b_r, double b_z) {
    return a_r * b_z - a_z * b_r;
}

}  // namespace

void ClosestNormal::start(const CellBox& box) {
    const double r = box.r0 + 0.5 * box.hr, z = box.z0 + 0.5 * box.hz, reach = std::hypot(box.hr, box.hz);
    // From the middle of the cell to the nearer end of a segment; a point of the cell is half of `reach` away, and the
    // rest of the segment may be nearer by its length.
    const auto nearest = [&](const ContourSegment& s) {
        return std::min(std::hypot(s[0][0] - r, s[0][1] - z), std::hypot(s[1][0] - r, s[1][1] - z));
    };
    double least = std::numeric_limits<double>::max();
    for (const auto& s : segments_) least = std::min(least, nearest(s));
    near_.clear();
    for (const auto& s : segments_)
        if (nearest(s) - std::hypot(s[1][0] - s[0][0], s[1][1] - s[0][1]) <= least + reach) near_.push_back(s);
}

PlanePoint ClosestNormal::at(double r, double z) const {
    const ContourSegment* closest = nullptr;
    double least = std::numeric_limits<double>::max(), t = 0;
    for (const auto& s : near_) {
        const double e_r = s[1][0] - s[0][0], e_z = s[1][1] - s[0][1], square = e_r * e_r + e_z * e_z;
        const double along = (r - s[0][0]) * e_r + (z - s[0][1]) * e_z;
        const double part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
        const double distance = std::hypot(r - s[0][0] - part * e_r, z - s[0][1] - part * e_z);
        if (distance >= least) continue;
        least = distance;
        closest = &s;
        t = part;
    }
    if (closest == nullptr) return {0, 0};
    // Newton's method for (x − a − t e) × (n_a + t (n_b − n_a)) = 0.
    const auto &a = (*closest)[0], &b = (*closest)[1];
    const double e_r = b[0] - a[0], e_z = b[1] - a[1], turn_r = b[7] - a[7], turn_z = b[8] - a[8];
    for (int iteration = 0; iteration < 3; ++iteration) {
        const double n_r = a[7] + t * turn_r, n_z = a[8] + t * turn_z, x_r = r - a[0] - t * e_r,
                     x_z = z - a[1] - t * e_z;
        const double slope = cross(x_r, x_z, turn_r, turn_z) - cross(e_r, e_z, n_r, n_z);
        if (slope == 0) break;
        t = std::clamp(t - cross(x_r, x_z, n_r, n_z) / slope, -1.0, 2.0);
    }
    const double n_r = a[7] + t * turn_r, n_z = a[8] + t * turn_z, length = std::hypot(n_r, n_z);
    return length > 0 ? PlanePoint{n_r / length, n_z / length} : PlanePoint{0, 0};
}

}  // namespace endoflow::phasefield
