// Input that is refused: the corpus wrong_cases.tsv, and every key with values at the edge of numbers and of types.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "shared/case/case_file.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"

using namespace endoflow;

namespace {

std::vector<std::string> split(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find(separator, begin)) != std::string::npos; begin = end + separator.size())
        parts.push_back(text.substr(begin, end - begin));
    parts.push_back(text.substr(begin));
    return parts;
}

/// \n, \t, \r, \\ and \xNN become characters.
std::string unescaped(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            result += text[i];
            continue;
        }
        const char kind = text.at(++i);
        if (kind == 'x') {
            result += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            result += kind == 'n' ? '\n' : kind == 't' ? '\t' : kind == 'r' ? '\r' : kind;
        }
    }
    return result;
}

/// The message that refuses the case; empty when it is accepted. Anything but an InputError fails the test.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
        (void)parse_case(text, "case.toml", overrides);
    } catch (const InputError& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "";
}

const std::vector<std::string> edge_values{
    "0",    "-0",     "0.0",    "-0.0",    "1",      "-1",       "-1.5",       "inf",
    "-inf", "+inf",   "nan",    "-nan",    "1e300",  "-1e300",   "5e-324",     "-5e-324",
    "\"\"", "\"0\"",  "'text'", "true",    "1e-300", "2.3e-308", "false",      "9223372036854775807",
    "[]",   "[1, 2]", "{}",     "{a = 1}", "1e16",   "07:32:00", "1979-05-27", "-9223372036854775808",
};

}  // namespace

TEST_CASE("each of the wrong cases is refused with the message it deserves") {
    std::ifstream stream(ENDOFLOW_WRONG_CASES);
    REQUIRE(stream);
    int count = 0;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line.front() == '#') continue;
        ++count;
        INFO(line);
        std::vector<std::string> columns = split(line, "\t");
        REQUIRE(columns.size() >= 2);
        const std::vector<std::string> expected = split(columns[0], " | ");
        columns.erase(columns.begin());
        for (auto& column : columns) column = unescaped(column);
        const std::string text = columns.front();
        columns.erase(columns.begin());
        const std::string message = refusal(text, columns);
        for (const auto& part : expected) CHECK_THAT(message, Catch::Matchers::Contains(part));
        CHECK(message.find('\n') == std::string::npos);
    }
    CHECK(count >= 200);
}

TEST_CASE("every key takes or refuses values at the edge of numbers and types, by its name") {
    for (const auto& row : parameter_table())
        for (const auto& value : edge_values) {
            INFO(row.name() << " = " << value);
            const std::string in_file = refusal("[" + row.section + "]\n" + row.key + " = " + value + "\n");
            const std::string overridden = refusal("", {row.name() + "=" + value});
            CHECK(in_file.empty() == overridden.empty());
            if (!in_file.empty()) {
                CHECK_THAT(in_file, Catch::Matchers::Contains(row.key));
                CHECK_THAT(overridden, Catch::Matchers::Contains(row.key));
            }
        }
}

TEST_CASE("numbers that no computation survives are refused for every key") {
    for (const auto& row : parameter_table()) {
        if (!std::holds_alternative<double>(row.default_value())) continue;
        INFO(row.name());
        for (const char* value : {"inf", "-inf", "nan", "1e300", "-1e300", "5e-324", "-5e-324", "1e-300"})
            CHECK_FALSE(refusal("[" + row.section + "]\n" + row.key + " = " + value + "\n").empty());
    }
}

TEST_CASE("values that are fine alone but ask for endless output or memory are refused") {
    const auto refused = [](const std::vector<std::string>& overrides, const std::string& word) {
        INFO(overrides.front());
        CHECK_THAT(refusal("", overrides), Catch::Matchers::Contains(word));
    };
    refused({"output.shape_interval=1e-9"}, "output.shape_interval");
    refused({"output.field_interval=1e-9"}, "output.field_interval");
    refused({"time.end=1e9"}, "output.field_interval");
    refused({"domain.radius=1e5", "domain.height=1e5", "domain.membrane_height=5e4"},
            "boundary_integral.field_spacing");
    refused({"phase_field.cell_size=1e-9"}, "phase_field.cell_size");
    refused({"phase_field.cell_size=0", "phase_field.epsilon=1e-9"}, "phase_field.epsilon");
    CHECK(
        refusal("", {"output.field_interval=0", "domain.radius=1e5", "domain.height=1e5", "domain.membrane_height=5e4"})
            .empty());
}

TEST_CASE("keys nested deeper than the stack are refused, not followed") {
    std::string deep = "time";
    for (int i = 0; i < 500'000; ++i) deep += ".a";
    CHECK_THAT(refusal(deep + " = 1\n"), Catch::Matchers::Contains("dots"));
    CHECK_THAT(refusal("[" + deep + "]\n"), Catch::Matchers::Contains("dots"));
    CHECK_THAT(refusal("", {"time.end={" + deep + "=1}"}), Catch::Matchers::Contains("a number"));
}
