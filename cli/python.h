#pragma once

#include <filesystem>

namespace endoflow::cli {

/// The Python that runs what is Python: the one named in the environment variable ENDOFLOW_PYTHON, else the first one
/// with all packages of `requirements` (a file as pip reads it) among the one found at configure time and every python3
/// in PATH, else the one that lacks fewest. Throws IoError when none can be started or all are too old.
[[nodiscard]] std::filesystem::path find_python(const std::filesystem::path& requirements);

}  // namespace endoflow::cli
