#include "shared/support/nearest_word.h"

#include <algorithm>
#include <limits>

namespace endoflow {

std::size_t edit_distance(const std::string& first, const std::string& second) {
    const std::size_t n = first.size(), m = second.size();
    std::vector<std::vector<std::size_t>> d(n + 1, std::vector<std::size_t>(m + 1));
    for (std::size_t i = 0; i <= n; ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= m; ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= n; ++i)
        for (std::size_t j = 1; j <= m; ++j) {
            const std::size_t change = first[i - 1] == second[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && first[i - 1] == second[j - 2] && first[i - 2] == second[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known) {
    constexpr std::size_t longest_word = 200;
    if (word.size() > longest_word) return std::nullopt;
    const auto after_dot = [](const std::string& text) { return text.substr(text.rfind('.') + 1); };
    std::optional<std::string> nearest;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const auto& candidate : known) {
        std::size_t distance = edit_distance(word, candidate);
        if (after_dot(word) == after_dot(candidate)) distance = std::min<std::size_t>(distance, 1);
        if (distance < least) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest && 2 * least <= after_dot(word).size() + 1 ? nearest : std::nullopt;
}

}  // namespace endoflow
