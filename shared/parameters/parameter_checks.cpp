#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

constexpr const char* type_names[] = {"true or false", "an integer", "a number", "a string"};

/// An integer is a valid way to write a number in a case file.
ParameterValue promoted(const ParameterValue& value, const ParameterValue& wanted) {
    if (std::holds_alternative<double>(wanted) && std::holds_alternative<long long>(value))
        return static_cast<double>(std::get<long long>(value));
    return value;
}

void check_number(const ParameterRow& row, double number, const std::string& where) {
    if (!std::isfinite(number) || !row.bounds.contains(number))
        throw InputError(fmt::format("{}: {} = {} is out of bounds; it must be {}", where, row.name(), number,
                                     describe_allowed(row)));
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
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const ParameterRow& row) { return row.name() == name; });
    return found == table.end() ? nullptr : &*found;
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
    if (const auto* text = std::get_if<std::string>(&given); text != nullptr && !row.choices.empty())
        if (std::find(row.choices.begin(), row.choices.end(), *text) == row.choices.end())
            throw InputError(fmt::format("{}: {} = \"{}\" is not known; it must be {}", where, row.name(), *text,
                                         describe_allowed(row)));
    row.set(parameters, given);
}

void validate_combination(const Parameters& p, const std::string& where) {
    const auto require = [&](bool holds, const std::string& message) {
        if (!holds) throw InputError(where + ": " + message);
    };
    if (p.domain.kind == DomainKind::box) {
        const double below = p.domain.membrane_height, above = p.domain.height - p.domain.membrane_height;
        require(p.molecules.patch_radius < p.domain.radius,
                fmt::format("molecules.patch_radius = {} nm must be smaller than domain.radius = {} nm",
                            p.molecules.patch_radius, p.domain.radius));
        const double room = p.domain.pin_half_width + p.domain.wall_clearance;
        require(below > room && above > room,
                fmt::format("domain.membrane_height = {} nm must lie farther than pin_half_width + wall_clearance = {} "
                            "nm from the bottom (0) and the top (domain.height = {} nm)",
                            below, room, p.domain.height));
    }
    require(p.time.initial_step <= p.time.max_step,
            fmt::format("time.initial_step = {} µs must not exceed time.max_step = {} µs", p.time.initial_step,
                        p.time.max_step));
}

}  // namespace endoflow
