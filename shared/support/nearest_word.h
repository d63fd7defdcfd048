#pragma once

#include <optional>
#include <string>
#include <vector>

namespace endoflow {

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
[[nodiscard]] std::size_t edit_distance(const std::string& first, const std::string& second);

/// The known word nearest to `word`, if one is near enough to be what was meant (within half its length).
/// Words "section.key" also match on what follows the last dot alone, so a key in the wrong section is found.
[[nodiscard]] std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace endoflow
