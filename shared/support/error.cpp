#include "shared/support/error.h"

#include <fmt/format.h>

namespace endoflow {

namespace {

bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

}  // namespace

std::string one_line(const std::string& text) {
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        if (is_control(c))
            result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
        else
            result += c;
    }
    return result;
}

}  // namespace endoflow
