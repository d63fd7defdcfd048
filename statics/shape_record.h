#pragma once

#include <optional>
#include <vector>

#include "statics/simulation.h"
#include "statics/state_writer.h"

namespace endoflow::statics {

/// The statics' own columns of history.csv for a membrane in the box.
[[nodiscard]] std::vector<ColumnText> shape_columns();

/// The case as it is solved: patch_radius is that of the initial profile.
[[nodiscard]] Parameters resolved(const Parameters& parameters, const Request& request);

/// A neck's hold, where there is one.
struct HoldRecord {
    double force;  // f, pN
    double work;   // ∫ f dR from the branch's first shape, pN nm
};

/// What a row says besides the shape.
struct PlaceOnBranch {
    std::optional<double> followed;  // value of what the branch goes along
    std::optional<HoldRecord> hold;
};

/// Writes a solution of stationary_shapes(). `named` is the case the user sees, `solved` the one that was computed.
/// Returns its figures.
Json write_state(StateWriter& writer, const Parameters& named, const Parameters& solved, const BranchPoint& point,
                 const PlaceOnBranch& place);

}  // namespace endoflow::statics
