#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shared/parameters/parameter_table.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

using ParameterRows = std::vector<ParameterRow>;

/// Rows as aligned plain text: name, default, unit, bounds, meaning.
[[nodiscard]] std::string render_parameters_text(const ParameterRows& rows = parameter_table());

/// Rows as Markdown tables, one per section.
[[nodiscard]] std::string render_parameters_markdown(const ParameterRows& rows = parameter_table());

/// Rows as a case file with these values (a complete one by default), each line annotated with unit, bounds and
/// meaning.
[[nodiscard]] std::string render_parameters_toml(const Parameters& parameters,
                                                 const ParameterRows& rows = parameter_table());

/// Rows as [{name, default, unit, allowed, symbol, meaning}].
[[nodiscard]] nlohmann::ordered_json describe_parameters(const ParameterRows& rows = parameter_table());

/// {"section": {"key": value}} with every parameter.
[[nodiscard]] nlohmann::ordered_json parameters_to_json(const Parameters& parameters);

/// A parameter's value in what parameters_to_json() made; nullptr where it is not there.
[[nodiscard]] const nlohmann::ordered_json* find_value(const nlohmann::ordered_json& parameters,
                                                       const ParameterRow& row);

}  // namespace endoflow
