#pragma once

#include <limits>
#include <optional>

#include "statics/held_branch.h"

namespace endoflow::statics {

/// The highest rise of the work on the way to a radius, among shapes that are nearer to it than all before: between the
/// folds of a branch a collar that sets the radius jumps.
struct Barrier {
    double height = 0;                  // pN nm
    double from_radius, to_radius = 0;  // where the rise begins and where it is that high, nm
};

/// The work ∫ f dR along a branch of held necks, from its first shape. Between shapes the branch is a cubic with its
/// tangents, which leaves an error of fourth order in the steps. Where 𝒢 is the only potential, with molecules that are
/// frozen in the material, the work is the difference of 𝒢.
class NeckWork {
  public:
    /// `end`: the radius to which the branch goes, nm.
    explicit NeckWork(double end) : end_(end) {}

    /// The work to the next shape, pN nm.
    double to(const HeldState& next);

    [[nodiscard]] const Barrier& barrier() const { return barrier_; }
    /// The largest inward force of the shapes, pN; negative where all necks are held open.
    [[nodiscard]] double strongest_constriction() const { return -least_force_; }

  private:
    struct Point {
        double radius, force, radius_rate, force_rate;  // the rates along the branch
    };

    std::optional<Point> last_;
    double end_, nearest_ = std::numeric_limits<double>::infinity();
    double work_ = 0, least_work_ = 0, least_radius_ = 0, least_force_ = 0;
    Barrier barrier_{};

    void pass(double work, double radius);
};

}  // namespace endoflow::statics
