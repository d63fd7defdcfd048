#pragma once

#include <string>

namespace endoflow {

/// Raised by one when results of an engine change beyond their tolerance; docs/results/data of a smaller one are stale.
inline constexpr int numerics_revision = 1;

/// The program's version, "major.minor.patch".
[[nodiscard]] std::string version();

/// `git describe` of the source tree the program was built from; "unknown" outside a checkout.
[[nodiscard]] std::string git_description();

/// Name and version of the compiler that built the program, "GNU 12.2.0" or "Clang 14.0.6".
[[nodiscard]] std::string compiler();

/// What files say wrote them: "endoflow 0.1.0 (git description)".
[[nodiscard]] std::string written_by();

}  // namespace endoflow
