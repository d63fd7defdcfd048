// Entry point of a fuzzer (libFuzzer's name and signature) for the reader of case files. The input is the text of a
// case file; what follows its first NUL byte are overrides as of --set, separated by NUL bytes.
//
// Whatever the input, it is either refused with one line that says where, or it gives parameters that can be written
// and read back unchanged.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "shared/case/case_file.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;

void require(bool holds, const char* property, const std::string& detail) {
    if (holds) return;
    std::fprintf(stderr, "violated: %s\n%s\n", property, detail.c_str());
    std::abort();
}

std::vector<std::string> split_at_nul(const std::string& input) {
    std::vector<std::string> parts(1);
    for (const char c : input) {
        if (c == '\0')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

void check_refusal(const InputError& error) {
    const std::string message = error.what();
    require(message.starts_with("case.toml") || message.starts_with("--set "), "a message begins with where", message);
    require(message.find('\n') == std::string::npos, "a message is one line", message);
}

void check_accepted(const Parameters& parameters) {
    const std::string text = render_parameters_toml(parameters);
    const Parameters again = parse_case(text, "case.toml", {});
    for (const auto& row : parameter_table())
        require(row.get(again) == row.get(parameters), "parameters are read back unchanged", row.name() + "\n" + text);
    require(!parameters_to_json(parameters).dump().empty(), "parameters are valid JSON", text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> parts = split_at_nul(std::string(reinterpret_cast<const char*>(data), size));
    const std::string text = parts.front();
    parts.erase(parts.begin());
    try {
        check_accepted(parse_case(text, "case.toml", parts));
    } catch (const InputError& error) {
        check_refusal(error);
    }
    return 0;
}
