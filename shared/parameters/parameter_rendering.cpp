#include "shared/parameters/parameter_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace endoflow {

namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            result += c;
    }
    return result + "\"";
}

std::string allowed(const ParameterRow& row) {
    return row.choices.empty() ? row.bounds.describe() : fmt::format("{}", fmt::join(row.choices, " | "));
}

/// Text for a cell of a Markdown table, where a bare | would end it.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, 1, '\\');
    return text;
}

/// "meaning [symbol]; unit; bounds" as one line.
std::string annotation(const ParameterRow& row) {
    std::string text = row.meaning;
    if (!row.symbol.empty()) text += " [" + row.symbol + "]";
    if (!row.unit.empty()) text += "; in " + row.unit;
    if (const auto range = allowed(row); !range.empty()) text += "; " + range;
    if (row.free_on_restart) text += "; free at a restart";
    return text;
}

}  // namespace

std::string to_toml(const ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<long long>(&value)) return fmt::format("{}", *number);
    if (const auto* number = std::get_if<double>(&value)) {
        const std::string text = fmt::format("{}", *number);
        return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }
    if (const auto* numbers = std::get_if<std::array<double, 2>>(&value))
        return fmt::format("[{}, {}]", to_toml(numbers->front()), to_toml(numbers->back()));
    return quoted(std::get<std::string>(value));
}

std::string render_parameters_text(const ParameterRows& rows) {
    std::size_t width = 0;
    for (const auto& row : rows) width = std::max(width, row.name().size());
    std::string text;
    for (const auto& row : rows)
        text += fmt::format("{:<{}}  {:<14}  {}\n", row.name(), width, to_toml(row.default_value()), annotation(row));
    return text;
}

std::string render_parameters_markdown(const ParameterRows& rows) {
    std::string text, section;
    for (const auto& row : rows) {
        if (row.section != section) {
            section = row.section;
            text +=
                fmt::format("\n## [{}]\n\n| key | default | unit | allowed | symbol | meaning | restart |\n", section);
            text += "| --- | --- | --- | --- | --- | --- | --- |\n";
        }
        text +=
            fmt::format("| `{}` | `{}` | {} | {} | {} | {} | {} |\n", row.key, to_toml(row.default_value()), row.unit,
                        cell(allowed(row)), cell(row.symbol), cell(row.meaning), row.free_on_restart ? "free" : "");
    }
    return text;
}

std::string render_parameters_toml(const Parameters& parameters, const ParameterRows& rows) {
    std::string text, section;
    for (const auto& row : rows) {
        if (row.section != section) {
            text += fmt::format("{}[{}]\n", section.empty() ? "" : "\n", row.section);
            section = row.section;
        }
        text += fmt::format("# {}\n{} = {}\n", annotation(row), row.key, to_toml(row.get(parameters)));
    }
    return text;
}

nlohmann::ordered_json describe_parameters(const ParameterRows& rows) {
    auto result = nlohmann::ordered_json::array();
    for (const auto& row : rows) {
        nlohmann::ordered_json entry{{"name", row.name()}};
        std::visit([&](const auto& value) { entry["default"] = value; }, row.default_value());
        entry.update({{"unit", row.unit}, {"allowed", allowed(row)}, {"symbol", row.symbol}, {"meaning", row.meaning}});
        result.push_back(entry);
    }
    return result;
}

namespace {

/// "a.b" as {"a", "b"}.
std::vector<std::string> parts(const std::string& section) {
    std::vector<std::string> out;
    std::size_t begin = 0;
    for (std::size_t dot; (dot = section.find('.', begin)) != std::string::npos; begin = dot + 1)
        out.push_back(section.substr(begin, dot - begin));
    out.push_back(section.substr(begin));
    return out;
}

}  // namespace

nlohmann::ordered_json parameters_to_json(const Parameters& parameters) {
    nlohmann::ordered_json result;
    for (const auto& row : parameter_table()) {
        auto* section = &result;  // [a.b] is an object within an object
        for (const auto& part : parts(row.section)) section = &(*section)[part];
        std::visit([&](const auto& value) { (*section)[row.key] = value; }, row.get(parameters));
    }
    return result;
}

const nlohmann::ordered_json* find_value(const nlohmann::ordered_json& parameters, const ParameterRow& row) {
    const auto* section = &parameters;
    for (const auto& part : parts(row.section)) {
        if (!section->contains(part)) return nullptr;
        section = &section->at(part);
    }
    return section->contains(row.key) ? &section->at(row.key) : nullptr;
}

}  // namespace endoflow
