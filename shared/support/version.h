#pragma once

#include <string>

namespace endoflow {

/// The program's version, "major.minor.patch".
[[nodiscard]] std::string version();

/// `git describe` of the source tree the program was built from; "unknown" outside a checkout.
[[nodiscard]] std::string git_description();

}  // namespace endoflow
