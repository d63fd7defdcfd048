#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// A parameter's value as a case file writes it; enumerations are strings.
using ParameterValue = std::variant<bool, long long, double, std::string, std::array<double, 2>>;

/// Closed or open interval of allowed numbers; the default allows every finite number.
struct Bounds {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowest_excluded = false;
    bool highest_excluded = false;

    [[nodiscard]] bool contains(double value) const;
    /// The allowed range in words, e.g. "> 0 and <= 100"; empty when every finite number is allowed.
    [[nodiscard]] std::string describe() const;
};

/// One parameter: everything that is said of it, anywhere, comes from this row. The default is the member's
/// initialiser in parameters.h, read through `get` from a default-constructed Parameters.
struct ParameterRow {
    std::string section;
    std::string key;
    std::string unit;
    Bounds bounds;
    std::string symbol;
    std::string meaning;
    std::vector<std::string> choices;
    std::function<ParameterValue(const Parameters&)> get;
    std::function<void(Parameters&, const ParameterValue&)> set;
    /// A restart may change it: it says how far, how accurately or with what output a run goes, not what it computes.
    bool free_on_restart = false;

    [[nodiscard]] std::string name() const { return section + "." + key; }
    [[nodiscard]] ParameterValue default_value() const { return get(Parameters{}); }
};

/// All parameters, ordered by section as in an annotated case file.
[[nodiscard]] const std::vector<ParameterRow>& parameter_table();

/// The row called "section.key", nullptr when there is none.
[[nodiscard]] const ParameterRow* find_parameter(const std::string& name);

/// The rows of a section and of the sections below it, or the one row called "section.key"; throws InputError with the
/// nearest known name when there is neither.
[[nodiscard]] std::vector<ParameterRow> find_parameters(const std::string& name);

/// A value in TOML syntax, numbers with as many digits as they need to be read back unchanged.
[[nodiscard]] std::string to_toml(const ParameterValue& value);

/// What the value must be: type, bounds and unit, or the list of choices.
[[nodiscard]] std::string describe_allowed(const ParameterRow& row);

/// Sets row's parameter after checking the value's type and bounds. Throws InputError that begins with `where`.
void set_parameter(Parameters& parameters, const ParameterRow& row, const ParameterValue& value,
                   const std::string& where);

}  // namespace endoflow
