#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "shared/model/bending_model.h"
#include "shared/model/loads.h"
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

/// Numbers nearer to zero are slips of the pen: products and quotients of them leave the range of double precision.
constexpr double smallest_magnitude = 1e-15;

/// More shapes or field files than this in a run, or points in one, fill disks and memories and are looked at by
/// nobody.
constexpr double most_outputs = 1e6;
constexpr double most_field_points = 1e7;

/// More cells of the phase field than this along the domain do not fit into any memory.
constexpr double most_cells_across = 2e5;

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
    if (const auto* text = std::get_if<std::string>(&given)) check_text(row, *text, where);
    row.set(parameters, given);
}

namespace {

using Require = std::function<void(bool holds, const std::string& message)>;

void check_box(const Parameters& p, const Require& require) {
    const double below = p.domain.membrane_height, above = p.domain.height - p.domain.membrane_height;
    require(p.molecules.patch_radius < p.domain.radius,
            fmt::format("molecules.patch_radius = {} nm must be smaller than domain.radius = {} nm",
                        p.molecules.patch_radius, p.domain.radius));
    const double room = p.domain.pin_half_width + p.domain.wall_clearance;
    require(below > room && above > room,
            fmt::format("domain.membrane_height = {} nm must lie farther than pin_half_width + wall_clearance = {} "
                        "nm from the bottom (0) and the top (domain.height = {} nm)",
                        below, room, p.domain.height));
    const double h = p.phase_field.cell_size > 0 ? p.phase_field.cell_size : p.phase_field.epsilon;
    require(std::max(p.domain.radius, p.domain.height) <= most_cells_across * h,
            fmt::format("phase_field.cell_size = {} nm (0: phase_field.epsilon = {} nm decides) is too small for "
                        "domain.radius = {} nm and domain.height = {} nm: more than {} cells",
                        p.phase_field.cell_size, p.phase_field.epsilon, p.domain.radius, p.domain.height,
                        most_cells_across));
    const double spacing = p.boundary_integral.field_spacing;
    require(
        p.output.field_interval == 0 || (p.domain.radius / spacing) * (p.domain.height / spacing) <= most_field_points,
        fmt::format("boundary_integral.field_spacing = {} nm gives more than {} points in a domain.radius = {} nm by "
                    "domain.height = {} nm; enlarge it, or set output.field_interval = 0",
                    spacing, most_field_points, p.domain.radius, p.domain.height));
}

/// Loads need a rim or walls; and no membrane is flat, to begin with, under a tension below that at which it buckles:
/// −β (j/R)², j = 3.8317 the first zero of J₁, for a disc whose edge is held horizontally.
void check_loads(const Parameters& p, const Require& require) {
    const Loads loads = loads_of(p);
    if (loads.none()) return;
    require(p.domain.kind == DomainKind::box,
            "membrane.rim_tension, membrane.pole_force and fluid.pressure_difference need domain.kind = \"box\"");
    require(
        p.membrane.inextensible,
        "membrane.rim_tension, membrane.pole_force and fluid.pressure_difference need membrane.inextensible = true");
    require(p.fluid.dynamics == Dynamics::flow,
            "membrane.rim_tension, membrane.pole_force and fluid.pressure_difference need fluid.dynamics = \"flow\"");
    constexpr double first_zero = 3.8317059702075125;
    const double stiffness = BendingModel(p.membrane).stiffness(0).value;
    const double buckling = -stiffness * std::pow(first_zero / p.domain.radius, 2);
    require(loads.rim_tension > buckling,
            fmt::format("membrane.rim_tension = {:g} pN/nm is not above {:.4g} pN/nm, where the flat membrane buckles",
                        loads.rim_tension, buckling));
}

void check_times(const Parameters& p, const Require& require) {
    require(p.time.initial_step <= p.time.max_step,
            fmt::format("time.initial_step = {} µs must not exceed time.max_step = {} µs", p.time.initial_step,
                        p.time.max_step));
    const auto check_interval = [&](const char* name, double interval) {
        require(p.time.end <= most_outputs * interval,
                fmt::format("output.{} = {} µs gives more than {} files or shapes until time.end = {} µs; enlarge it",
                            name, interval, most_outputs, p.time.end));
    };
    check_interval("shape_interval", p.output.shape_interval);
    if (p.output.field_interval > 0) check_interval("field_interval", p.output.field_interval);
}

}  // namespace

void validate_combination(const Parameters& p, const std::string& where) {
    const Require require = [&](bool holds, const std::string& message) {
        if (!holds) throw InputError(where + ": " + message);
    };
    if (p.domain.kind == DomainKind::box) check_box(p, require);
    check_loads(p, require);
    check_times(p, require);
}

}  // namespace endoflow
