#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace endoflow::phasefield {

/// Where the level set crosses a line between lattice points of a cell, and the fields there.
struct ContourPoint {
    double r = 0, z = 0;                    // [nm]
    double molecules = 0;                   // c
    double tension = 0, curvature = 0;      // sharp λ [pN/nm], κ [1/nm]
    double velocity_r = 0, velocity_z = 0;  // [nm/µs]
    double normal_r = 0, normal_z = 0;      // ∇ψ/|∇ψ|

    bool operator==(const ContourPoint&) const = default;

    template <class Archive>  // of Boost.Serialization, with which processes exchange segments
    void serialize(Archive& archive, unsigned int /*version*/) {
        archive& r& z& molecules& tension& curvature& velocity_r& velocity_z& normal_r& normal_z;
    }
};

/// [nm]
inline double distance_between(const ContourPoint& a, const ContourPoint& b) {
    return std::hypot(b.r - a.r, b.z - a.z);
}

/// Two points joined inside one cell.
using ContourSegment = std::array<ContourPoint, 2>;

/// A maximal chain of segments, open or closed.
using ContourChain = std::vector<ContourPoint>;

/// Joins segments whose end points agree within `tolerance` [nm] into chains.
std::vector<ContourChain> join_segments(const std::vector<ContourSegment>& segments, double tolerance);

/// Drops points nearer than `spacing` to their predecessor; the first and the last stay.
ContourChain thin_out(const ContourChain& chain, double spacing);

}  // namespace endoflow::phasefield
