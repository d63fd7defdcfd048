#include "phasefield/contour/closest_normal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace endoflow::phasefield {

namespace {

double cross(const PlanePoint& a, const PlanePoint& b) {
    return a.r * b.z - a.z * b.r;
}

/// a + t b.
PlanePoint along(const PlanePoint& a, double t, const PlanePoint& b) {
    return {a.r + t * b.r, a.z + t * b.z};
}

/// A segment seen from x: a + t edge − x with the normal n + t turn.
struct View {
    PlanePoint start, edge, normal, turn;

    View(const ContourSegment& s, const PlanePoint& x)
        : start{s[0].r - x.r, s[0].z - x.z},
          edge{s[1].r - s[0].r, s[1].z - s[0].z},
          normal{s[0].normal_r, s[0].normal_z},
          turn{s[1].normal_r - s[0].normal_r, s[1].normal_z - s[0].normal_z} {}

    /// t of the chord's closest point.
    [[nodiscard]] double closest() const {
        const double square = edge.r * edge.r + edge.z * edge.z;
        return square > 0 ? std::clamp(-(start.r * edge.r + start.z * edge.z) / square, 0.0, 1.0) : 0;
    }

    [[nodiscard]] double distance(double t) const {
        const PlanePoint to = along(start, t, edge);
        return std::hypot(to.r, to.z);
    }

    /// Newton's method for (a + t edge − x) × (n + t turn) = 0: the normal there points to x or away from it.
    [[nodiscard]] double foot(double t) const {
        for (int iteration = 0; iteration < 3; ++iteration) {
            const PlanePoint to = along(start, t, edge), n = along(normal, t, turn);
            const double slope = cross(edge, n) + cross(to, turn);
            if (slope == 0) break;
            t = std::clamp(t - cross(to, n) / slope, -1.0, 2.0);
        }
        return t;
    }
};

}  // namespace

void ClosestNormal::start(const CellBox& box) {
    const ContourPoint middle{box.r0 + 0.5 * box.hr, box.z0 + 0.5 * box.hz};
    // From the middle of the cell to the nearer end of each segment; a point of the cell is half a diagonal away, and
    // the rest of the segment may be nearer by its length.
    nearer_end_.clear();
    for (const auto& s : segments_)
        nearer_end_.push_back(std::min(distance_between(s[0], middle), distance_between(s[1], middle)));
    const double least = segments_.empty() ? 0 : std::ranges::min(nearer_end_), diagonal = std::hypot(box.hr, box.hz);
    near_.clear();
    for (std::size_t i = 0; i < segments_.size(); ++i)
        if (nearer_end_[i] - distance_between(segments_[i][0], segments_[i][1]) <= least + diagonal)
            near_.push_back(segments_[i]);
}

PlanePoint ClosestNormal::at(double r, double z) const {
    const ContourSegment* closest = nullptr;
    double least = std::numeric_limits<double>::max();
    for (const auto& s : near_) {
        const View view(s, {r, z});
        const double distance = view.distance(view.closest());
        if (distance >= least) continue;
        least = distance;
        closest = &s;
    }
    if (closest == nullptr) return {0, 0};
    const View view(*closest, {r, z});
    const PlanePoint n = along(view.normal, view.foot(view.closest()), view.turn);
    const double length = std::hypot(n.r, n.z);
    return length > 0 ? PlanePoint{n.r / length, n.z / length} : PlanePoint{0, 0};
}

}  // namespace endoflow::phasefield
