#pragma once

#include <functional>
#include <optional>

namespace endoflow {

/// When, between `begin` and `end`, a quantity falls below a level, to round-off; `begin` when it was below it already,
/// nothing when it is above it at the end. The quantity may be infinite above the level: that of what does not exist.
[[nodiscard]] std::optional<double> falls_below(const std::function<double(double time)>& quantity, double begin,
                                                double end, double level);

}  // namespace endoflow
