#pragma once

#include <utility>
#include <vector>

#include "phasefield/contour/chain.h"
#include "phasefield/fem/mesh.h"

namespace endoflow::phasefield {

/// The level set's unit normal at the point of the contour that is closest to another point: the gradient there of the
/// contour's distance, known without the level set's own values away from the contour.
class ClosestNormal {
  public:
    explicit ClosestNormal(std::vector<ContourSegment> segments) : segments_(std::move(segments)) {}

    /// Selects the segments that may be closest to a point of the cell.
    void start(const CellBox& box);
    /// At a point of the cell [nm]. Between the ends of a segment the normal changes linearly and points to where the
    /// contour is closest, so its error is of second order in the segments' length. Zero without a contour.
    [[nodiscard]] PlanePoint at(double r, double z) const;

  private:
    std::vector<ContourSegment> segments_, near_;
    std::vector<double> nearer_end_;  // of each segment from the middle of the cell [nm]
};

}  // namespace endoflow::phasefield
