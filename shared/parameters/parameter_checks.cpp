#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"
#include "shared/support/nearest_word.h"

namespace endoflow {

namespace {

constexpr const char* type_names[] = {"true or false", "an integer", "a number", "a string", "two numbers [a, b]"};

/// An integer is a valid way to write a number in a case file.
ParameterValue promoted(const ParameterValue& value, const ParameterValue& wanted) {
    if (std::holds_alternative<double>(wanted) && std::holds_alternative<long long>(value))
        return static_cast<double>(std::get<long long>(value));
    return value;
}

/// Numbers nearer to zero are slips of the pen: products and quotients of them leave the range of double precision.
constexpr double smallest_magnitude = 1e-15;

void check_number(const ParameterRow& row, double number, const std::string& where) {
    if (!std::isfinite(number) || !row.bounds.contains(number))
        throw InputError(fmt::format("{}: {} = {} is out of bounds; it must be {}", where, row.name(), number,
                                     describe_allowed(row)));
    if (number != 0 && std::abs(number) < smallest_magnitude)
        throw InputError(
            fmt::format("{}: {} = {} is too near to zero to compute with; it must be {}, in magnitude >= {}", where,
                        row.name(), number, describe_allowed(row), smallest_magnitude));
}

/// Length of the UTF-8 character at the beginning of `text`, 0 when there is none (RFC 3629).
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second > 0x9F;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const bool overlong = first == 0xF0 && second < 0x90, too_large = first == 0xF4 && second > 0x8F;
        return continues(1) && continues(2) && continues(3) && !overlong && !too_large ? 4 : 0;
    }
    return 0;
}

/// Texts go into run.json, file headers and terminals: valid UTF-8, no control characters but tabs and ends of lines.
bool is_printable(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0) return false;
        const char c = text.front();
        const bool white = c == '\t' || c == '\n' || c == '\r';
        if (length == 1 && !white && (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)) return false;
        text.remove_prefix(length);
    }
    return true;
}

void check_text(const ParameterRow& row, const std::string& text, const std::string& where) {
    const auto& choices = row.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
        throw InputError(
            fmt::format("{}: {} = \"{}\" is not known; it must be {}", where, row.name(), text, describe_allowed(row)));
    if (!is_printable(text))
        throw InputError(fmt::format("{}: {} holds control characters or is not UTF-8; it must be a printable string",
                                     where, row.name()));
}

}  // namespace

bool Bounds::contains(double value) const {
    const bool above = lowest_excluded ? value > lowest : value >= lowest;
    const bool below = highest_excluded ? value < highest : value <= highest;
    return above && below;
}

std::string Bounds::describe() const {
    std::string text;
    if (std::isfinite(lowest)) text = fmt::format("{} {}", lowest_excluded ? ">" : ">=", lowest);
    if (std::isfinite(highest))
        text += fmt::format("{}{} {}", text.empty() ? "" : " and ", highest_excluded ? "<" : "<=", highest);
    return text;
}

const ParameterRow* find_parameter(const std::string& name) {
    const auto& table = parameter_table();
    const auto found = std::find_if(table.begin(), table.end(), [&](const ParameterRow& row) {
        return name.size() == row.section.size() + 1 + row.key.size() && name.starts_with(row.section) &&
               name[row.section.size()] == '.' && name.ends_with(row.key);
    });
    return found == table.end() ? nullptr : &*found;
}

std::vector<ParameterRow> find_parameters(const std::string& name) {
    std::vector<ParameterRow> rows;
    std::vector<std::string> known;
    for (const auto& row : parameter_table()) {
        known.push_back(row.name());
        if (std::find(known.begin(), known.end(), row.section) == known.end()) known.push_back(row.section);
        if ((row.name() + ".").starts_with(name + ".")) rows.push_back(row);
    }
    if (!rows.empty()) return rows;
    const auto nearest = nearest_word(name, known);
    throw InputError(fmt::format("{}: no such section or parameter; {}", name,
                                 nearest ? fmt::format("did you mean '{}'?", *nearest) : "leave it out to see all"));
}

std::string describe_allowed(const ParameterRow& row) {
    if (!row.choices.empty()) return fmt::format("one of \"{}\"", fmt::join(row.choices, "\", \""));
    std::string text = type_names[row.default_value().index()];
    const std::string range = row.bounds.describe();
    if (!range.empty()) text += " " + range;
    if (!row.unit.empty()) text += " (in " + row.unit + ")";
    return text;
}

void set_parameter(Parameters& parameters, const ParameterRow& row, const ParameterValue& value,
                   const std::string& where) {
    const ParameterValue wanted = row.default_value();
    const ParameterValue given = promoted(value, wanted);
    if (given.index() != wanted.index())
        throw InputError(fmt::format("{}: {} is {}; it must be {}", where, row.name(), type_names[given.index()],
                                     describe_allowed(row)));
    if (const auto* number = std::get_if<double>(&given)) check_number(row, *number, where);
    if (const auto* number = std::get_if<long long>(&given)) check_number(row, static_cast<double>(*number), where);
    if (const auto* numbers = std::get_if<std::array<double, 2>>(&given))
        for (const double number : *numbers) check_number(row, number, where);
    if (const auto* text = std::get_if<std::string>(&given)) check_text(row, *text, where);
    row.set(parameters, given);
}

}  // namespace endoflow
