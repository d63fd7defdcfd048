#include "shared/case/case_file.h"

#include <fmt/format.h>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "shared/case/case_checks.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"
#include "shared/support/nearest_word.h"

namespace endoflow {

namespace {

/// Larger case files than this are refused before they are read: no sensible case comes near it.
constexpr std::uintmax_t largest_case_file = 1 << 20;

/// Each dot of a key is a table within a table, and deep trees of tables exhaust the stack when they are destroyed.
constexpr std::ptrdiff_t most_dots = 4000;

std::string location(const std::string& source_name, const toml::source_region& region) {
    return fmt::format("{}:{}:{}", source_name, region.begin.line, region.begin.column);
}

const std::set<std::string>& known_sections() {
    static const std::set<std::string> sections = [] {
        std::set<std::string> names;
        for (const auto& row : parameter_table()) names.insert(row.section);
        return names;
    }();
    return sections;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
    const auto nearest = nearest_word(word, known);
    return nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : "; 'endoflow params' lists every parameter";
}

std::string unknown_section_message(const std::string& section) {
    const auto& sections = known_sections();
    return fmt::format("unknown section [{}]{}", section, suggestion(section, {sections.begin(), sections.end()}));
}

std::string unknown_key_message(const std::string& section, const std::string& key) {
    for (const auto& row : parameter_table())
        if (row.key == key && row.section.starts_with(section + "."))
            return fmt::format("{}.{} has a section of its own: write {}", section, key, row.name());
    std::vector<std::string> names;
    for (const auto& row : parameter_table()) names.push_back(row.name());
    return fmt::format("unknown key {}.{}{}", section, key, suggestion(section + "." + key, names));
}

/// Both numbers of an array of two; empty when it is anything else.
std::optional<std::array<double, 2>> two_numbers(const toml::node& node) {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2) return std::nullopt;
    std::array<double, 2> numbers{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto number = array->get(i)->is_number() ? array->get(i)->value<double>() : std::nullopt;
        if (!number) return std::nullopt;
        numbers[i] = *number;
    }
    return numbers;
}

ParameterValue value_of(const toml::node& node, const std::string& name, const std::string& where) {
    if (const auto* value = node.as_boolean()) return value->get();
    if (const auto* value = node.as_integer()) return static_cast<long long>(value->get());
    if (const auto* value = node.as_floating_point()) return value->get();
    if (const auto* value = node.as_string()) return value->get();
    if (const auto numbers = two_numbers(node)) return *numbers;
    const ParameterRow* row = find_parameter(name);
    throw InputError(fmt::format("{}: {} must be {}", where, name, row ? describe_allowed(*row) : "a single value"));
}

/// The table of a section, where it stands; throws when it is anything else.
const toml::table& section_table(const toml::key& key, const toml::node& node, const std::string& name,
                                 const std::string& source_name) {
    const std::string where = location(source_name, key.source());
    if (!known_sections().contains(name)) throw InputError(where + ": " + unknown_section_message(name));
    if (!node.is_table()) throw InputError(fmt::format("{}: {} must be a section, written [{}]", where, name, name));
    return *node.as_table();
}

void apply_section(Parameters& parameters, const std::string& section, const toml::table& keys,
                   const std::string& source_name) {
    for (const auto& [key, node] : keys) {
        const std::string where = location(source_name, node.source());
        const std::string name = section + "." + std::string(key.str());
        if (known_sections().contains(name)) {
            apply_section(parameters, name, section_table(key, node, name, source_name), source_name);
            continue;
        }
        const ParameterRow* row = find_parameter(name);
        if (row == nullptr)
            throw InputError(fmt::format("{}: {}", location(source_name, key.source()),
                                         node.is_table() ? unknown_section_message(name)
                                                         : unknown_key_message(section, std::string(key.str()))));
        set_parameter(parameters, *row, value_of(node, name, where), where);
    }
}

void apply_document(Parameters& parameters, const toml::table& document, const std::string& source_name) {
    for (const auto& [section, node] : document) {
        const std::string name(section.str());
        apply_section(parameters, name, section_table(section, node, name, source_name), source_name);
    }
}

/// "12" → 12, "true" → true, "consistent" → "consistent": TOML syntax, with bare words taken as strings.
ParameterValue override_value(const std::string& text, const std::string& name, const std::string& where) {
    if (text.find_first_of("\r\n") == std::string::npos && std::count(text.begin(), text.end(), '.') <= most_dots) {
        try {
            const toml::table parsed = toml::parse("value = " + text);
            return value_of(*parsed.get("value"), name, where);
        } catch (const toml::parse_error&) {
            // Not TOML: a bare word such as consistent, or a number such as .5, which TOML wants written 0.5.
        }
    }
    double number = 0;
    const char *begin = text.c_str() + (text.starts_with('+') ? 1 : 0), *end = text.c_str() + text.size();
    const auto [rest, error] = std::from_chars(begin, end, number);
    if (error == std::errc() && rest == end) return number;
    if (error == std::errc::result_out_of_range && rest == end)
        throw InputError(fmt::format("{}: {} is out of the range of numbers; {} must be {}", where, text, name,
                                     describe_allowed(*find_parameter(name))));
    return text;
}

void apply_override(Parameters& parameters, const std::string& text) {
    const auto equals = text.find('=');
    const auto dot = text.substr(0, equals).rfind('.');
    if (equals == std::string::npos || dot == std::string::npos)
        throw InputError(fmt::format("--set {}: it must read section.key=value", text));
    const std::string where = "--set " + text;
    const std::string section = text.substr(0, dot), key = text.substr(dot + 1, equals - dot - 1);
    if (!known_sections().contains(section)) throw InputError(where + ": " + unknown_section_message(section));
    const ParameterRow* row = find_parameter(section + "." + key);
    if (row == nullptr) throw InputError(where + ": " + unknown_key_message(section, key));
    set_parameter(parameters, *row, override_value(text.substr(equals + 1), row->name(), where), where);
}

std::string read_text(const std::filesystem::path& file) {
    std::error_code failure;
    if (!std::filesystem::exists(file, failure))
        throw InputError(file.string() + ": no such case file; give the path of a TOML file");
    if (std::filesystem::is_directory(file, failure))
        throw InputError(file.string() + ": is a directory; give the path of a TOML file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw IoError(file.string() + ": the case file cannot be read; check its permissions");
    std::string text;
    char block[4096];
    while (stream.read(block, sizeof block) || stream.gcount() > 0) {
        text.append(block, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > largest_case_file)
            throw InputError(fmt::format("{}: larger than {} bytes; a case file is a short TOML text", file.string(),
                                         largest_case_file));
    }
    if (stream.bad()) throw IoError(file.string() + ": the case file cannot be read to its end");
    return text;
}

}  // namespace

Parameters parse_case(const std::string& text, const std::string& source_name,
                      const std::vector<std::string>& overrides) {
    if (std::count(text.begin(), text.end(), '.') > most_dots)
        throw InputError(fmt::format("{}: more than {} dots; a case file is a short TOML text with keys in sections",
                                     source_name, most_dots));
    Parameters parameters;
    try {
        apply_document(parameters, toml::parse(text, source_name), source_name);
    } catch (const toml::parse_error& error) {
        throw InputError(
            fmt::format("{}: not valid TOML: {}", location(source_name, error.source()), error.description()));
    }
    for (const auto& item : overrides) apply_override(parameters, item);
    check_case(parameters, source_name);
    return parameters;
}

Parameters read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return parse_case(read_text(file), file.string(), overrides);
}

}  // namespace endoflow
