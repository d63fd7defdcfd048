#pragma once

#include <string>

namespace endoflow {

/// The program's version, "major.minor.patch".
[[nodiscard]] std::string version();

/// `git describe` of the source tree the program was built from; "unknown" outside a checkout.
[[nodiscard]] std::string git_description();

/// What files say wrote them: "endoflow 0.1.0 (git description)".
[[nodiscard]] std::string written_by();

}  // namespace endoflow
