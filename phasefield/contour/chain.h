#pragma once

#include <array>
#include <vector>

namespace endoflow::phasefield {

/// r, z, c, λ, κ, u_r, u_z and the components of the level set's unit normal at a point of the contour.
using ContourPoint = std::array<double, 9>;

/// Two points joined inside one cell.
using ContourSegment = std::array<ContourPoint, 2>;

/// A maximal chain of segments, open or closed.
using ContourChain = std::vector<ContourPoint>;

/// Joins segments whose end points agree within `tolerance` [nm] into chains.
std::vector<ContourChain> join_segments(const std::vector<ContourSegment>& segments, double tolerance);

/// Drops points nearer than `spacing` to their predecessor; the first and the last stay.
ContourChain thin_out(const ContourChain& chain, double spacing);

}  // namespace endoflow::phasefield
