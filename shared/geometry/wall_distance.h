#pragma once

#include <limits>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// How near a membrane comes to the walls of its box. The rim ends on the side wall, so of the side wall only what lies
/// farther than a margin from the rim counts, measured along the membrane.
class WallDistance {
  public:
    explicit WallDistance(const DomainParameters& domain) : domain_(domain) {}

    /// A point of the membrane and how far it is from the rim along the membrane; all in nm.
    void look_at(double r, double z, double to_rim);

    /// Of the nearest point seen, nm.
    [[nodiscard]] double smallest() const { return smallest_; }

    /// Throws SolverError("membrane-near-wall") when the membrane is nearer to a wall than domain.wall_clearance.
    /// `time` in µs.
    void require_clearance(double time) const;

  private:
    DomainParameters domain_;
    double smallest_ = std::numeric_limits<double>::infinity();
    const char* wall_ = "";
    double r_ = 0, z_ = 0;  // where that is, nm

    void look_at(const char* wall, double distance, double r, double z);
};

}  // namespace endoflow
