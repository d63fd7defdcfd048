#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Reads a case file (TOML), then applies the overrides ("section.key=value") in their order, then checks the result.
/// Throws InputError naming file:line:column, the key, and what is allowed; an unknown key names the nearest known one.
[[nodiscard]] Parameters read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The same from text; `source_name` stands for the file in messages.
[[nodiscard]] Parameters parse_case(const std::string& text, const std::string& source_name,
                                    const std::vector<std::string>& overrides);

}  // namespace endoflow
