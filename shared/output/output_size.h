#pragma once

#include <string>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// What a run writes, foreseen without running it.
struct OutputSize {
    long shapes = 0;
    long field_files = 0;
    double bytes = 0;  // of both; what else a run writes is little
};

/// From `start` [µs] to time.end, for the engine of this name. To a factor of two: elements, cells and points that are
/// added where the membrane gets narrow are not foreseen, and a run may end before time.end.
[[nodiscard]] OutputSize expected_output(const Parameters& parameters, const std::string& engine, double start = 0);

/// What to change where that is too much.
inline constexpr const char* less_output =
    "enlarge output.field_interval or set it to 0, and leave output.shape_interval at 0";

/// A sentence without its full stop about a run that writes much, more than a gigabyte; else empty.
[[nodiscard]] std::string much_output(const Parameters& parameters, const std::string& engine, double start = 0);

}  // namespace endoflow
