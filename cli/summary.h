#pragma once

#include <filesystem>
#include <string>

namespace endoflow::cli {

/// One screen about a run: what it was, how it ended, what it measured last. Throws IoError.
[[nodiscard]] std::string summarize_run(const std::filesystem::path& directory);

}  // namespace endoflow::cli
