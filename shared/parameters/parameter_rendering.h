#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Every parameter as aligned plain text: name, default, unit, bounds, meaning.
[[nodiscard]] std::string render_parameters_text();

/// Every parameter as Markdown tables, one per section.
[[nodiscard]] std::string render_parameters_markdown();

/// A complete case file with these values, each line annotated with unit, bounds and meaning.
[[nodiscard]] std::string render_parameters_toml(const Parameters& parameters);

/// {"section": {"key": value}} with every parameter.
[[nodiscard]] nlohmann::ordered_json parameters_to_json(const Parameters& parameters);

}  // namespace endoflow
