#pragma once

#include "shared/support/error.h"
#include "statics/held_neck.h"
#include "statics/stationary_state.h"

namespace endoflow::statics {

/// A shape whose narrowest neck is held.
struct HeldState {
    HeldCase held;
    BranchPoint point;  // of held_shapes()

    [[nodiscard]] double force() const { return point.solution.globals(held_global::force); }  // f, pN
};

/// What keeps a solution of held_shapes() from being a shape whose narrowest place is the held one.
enum class HeldFault {
    open,      // the held place is not narrower than its surroundings: neck and bud have met
    narrower,  // another place is narrower
    crossing,  // the meridian crosses itself
};

/// The fault of a solution, empty when it has none.
[[nodiscard]] std::optional<HeldFault> fault_of(const HeldCase& held, const PiecewiseSolution& solution,
                                                const GaussRule& rule);

/// Called at every shape, also the first and the last; false stops.
using HeldVisitor = std::function<bool(const HeldState&)>;

/// Following the radius at which a neck is held.
struct HeldBranch {
    Branch branch;                   // its last point is the faulty one
    std::optional<HeldFault> fault;  // for which it was stopped
    double last_radius;              // of a shape without a fault, nm
};

/// A shape of the case with a neck held at a radius that is found on the way: the case with the spontaneous curvature
/// at which the membrane has a neck of its own, whose radius is then kept while curvature, pressure and pole force go
/// to the case's. Throws SolverError "no-held-neck", or what held_failure() says of the shape.
[[nodiscard]] HeldState find_held_neck(const Parameters& parameters, const Resolution& resolution = {});

/// The branch from a shape in the radius of its neck [nm].
[[nodiscard]] HeldBranch follow_radius(const HeldState& from, double end, const HeldVisitor& visit,
                                       const Resolution& resolution = {});

/// Why a branch did not come to the radius [nm].
[[nodiscard]] SolverError held_failure(const HeldBranch& branch, double wanted);

/// The shape whose neck is held at this radius, on the branch from another one. Throws what held_failure() says.
[[nodiscard]] HeldState held_at(const HeldState& from, double radius, const Resolution& resolution = {});

/// The shape with the widest neck on the branch from another one, to one step of the continuation: beyond, neck and
/// bud meet, or the branch folds back.
[[nodiscard]] HeldState widest_held(const HeldState& from, const Resolution& resolution = {});

/// The shape on a mesh with every element cut in two. Empty when Newton's method fails.
[[nodiscard]] std::optional<HeldState> refined_held(const HeldState& coarse, const Resolution& resolution = {});

}  // namespace endoflow::statics
