#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "statics/newton.h"

namespace endoflow::statics {

/// A point of a branch and the direction in which the branch is followed.
struct BranchPoint {
    PiecewiseSolution solution;
    PiecewiseSolution tangent;
    double arc_length = 0;
    int folds_before = 0;  // folds passed on the way here
};

/// Where the parameter has an extremum along the branch.
struct Fold {
    BranchPoint point;
    [[nodiscard]] double parameter() const { return point.solution.parameter; }
};

/// Why following a branch ended.
enum class BranchEnd {
    reached_target,  // the last point lies at the target
    returned,        // the parameter came back to where the branch began
    stopped,         // the visitor asked for it
    no_progress,     // the step along the branch fell below its limit: the branch ends, e.g. where a neck closes
    too_long,        // more points than allowed
};

[[nodiscard]] std::string to_string(BranchEnd end);

struct ContinuationSettings {
    double first_step = 0.02;  // arc length, in units of the problem's scales
    double longest_step = 0.2;
    double shortest_step = 1e-5;
    int most_points = 1000;
    double least_cosine = 0.96;  // of the angle between the tangents of neighbouring points
};

struct Branch {
    BranchPoint last;
    std::vector<Fold> folds;
    BranchEnd end = BranchEnd::too_long;
};

/// Says whether a solution is admissible: inadmissible points make the step shorter.
using Admissible = std::function<bool(const PiecewiseSolution&)>;
/// Called at every point, also the first and the last; false stops.
using Visitor = std::function<bool(const BranchPoint&)>;

/// Solves at guess.parameter and finds the direction in which the parameter moves towards `target`.
/// Empty when Newton's method fails.
[[nodiscard]] std::optional<BranchPoint> begin_branch(const BoundaryValueProblem& problem, const GaussRule& rule,
                                                      const PiecewiseSolution& guess, double target);

/// The same from another problem's solution, which is interpolated on `elements` elements.
[[nodiscard]] std::optional<BranchPoint> begin_branch_at(const BoundaryValueProblem& problem, const GaussRule& rule,
                                                         const PiecewiseSolution& solution, std::size_t elements,
                                                         double parameter, double target);

/// Pseudo-arclength continuation (H. B. Keller 1977) from `start` until the parameter reaches `target` for the first
/// time, folds being located on the way. The mesh is adapted at every point, its number of elements stays.
[[nodiscard]] Branch follow_branch(const BoundaryValueProblem& problem, const GaussRule& rule, const BranchPoint& start,
                                   double target, const ContinuationSettings& settings, const Admissible& admissible,
                                   const Visitor& visit);

}  // namespace endoflow::statics
