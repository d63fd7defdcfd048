#pragma once

#include <array>

#include "shared/support/error.h"
#include "statics/continuation.h"
#include "statics/shape_equations.h"

namespace endoflow::statics {

/// A stationary membrane of one case.
struct StationaryState {
    Parameters parameters;
    BranchPoint point;          // its parameter is the last one in which it was followed
    double relative_error = 0;  // largest change of area, height and apex moment when every element was cut in two
};

/// What following the shapes gave: from the flat membrane under the case's tension alone to the case's H0, then to its
/// loads (`load_keys`).
struct Search {
    std::string key = "membrane.spontaneous_curvature";  // in which the last branch was followed
    std::optional<Branch> branch;          // the last one; empty when there is not even a solution at H0 = 0
    std::optional<StationaryState> state;  // empty when the branch does not reach the case
};

/// Order of collocation and size of the first mesh.
struct Resolution {
    int points = 5;             // per element
    std::size_t elements = 48;  // while a branch is followed; a state is then refined
};

/// A branch is not followed beyond the first neck that is narrower than this, nm: the neck closes.
inline constexpr double closed_neck_radius = 1.0;

/// The stationary state that is connected with the flat membrane: the first one that is met at the case's H0 and loads.
[[nodiscard]] Search search_stationary_state(const Parameters& parameters, const Resolution& resolution = {});

/// The branch from the flat membrane in membrane.spontaneous_curvature, from 0 to `curvature`, as long as `go_on` says
/// so. Empty when Newton's method fails at once.
[[nodiscard]] std::optional<Branch> branch_from_flat(const Parameters& parameters, double curvature,
                                                     const Resolution& resolution, const Visitor& go_on);

/// Loads that a shape is followed to one by one, in this order, from the membrane under its tension alone.
inline constexpr std::array load_keys{"fluid.pressure_difference", "membrane.pole_force", "membrane.coat_force",
                                      "membrane.collar_force"};

/// The case without these.
[[nodiscard]] Parameters without_loads(Parameters parameters);

/// |H0|, or what stands for it where that is 0, 1/nm.
[[nodiscard]] double scale_of_curvature(const Parameters& parameters);

/// The number that a parameter called "section.key" has.
[[nodiscard]] double number_of(const Parameters& parameters, const std::string& key);

/// The path of cases that differ in one number of the parameter table.
[[nodiscard]] CasePath path_in(const Parameters& parameters, const std::string& key);

/// Whether the membrane's apex is nearer to the top or bottom of the box than domain.wall_clearance.
[[nodiscard]] bool reaches_top_or_bottom(const Parameters& parameters, const PiecewiseSolution& solution);

/// Whether a branch ended because its neck closes.
[[nodiscard]] bool neck_closes(const Branch& branch);

/// Why the search found nothing, with the places of the folds in H0 and, computed here, in the patch radius.
[[nodiscard]] SolverError explain_absence(const Parameters& parameters, const Search& search,
                                          const Resolution& resolution = {});

/// search_stationary_state(); throws what explain_absence() says when there is none.
[[nodiscard]] StationaryState find_stationary_state(const Parameters& parameters, const Resolution& resolution = {});

/// The branch through a state in another parameter, from the state's value to `end`. `with(value)` is the state's
/// case with that parameter changed. Empty when Newton's method fails at once.
[[nodiscard]] std::optional<Branch> continue_state(const StationaryState& state, const CasePath& with, double begin,
                                                   double end, const Visitor& visit, const Resolution& resolution = {});

/// The case in which patch_radius counts as the radius of the disc with the same mass, π r_c². The initial profile
/// has mass π (r_c² + π² ε_c²/6), so the radius is reduced accordingly. Throws InputError for a patch that is too
/// small.
[[nodiscard]] Parameters with_disc_mass(Parameters parameters);

}  // namespace endoflow::statics
