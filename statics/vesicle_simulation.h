#pragma once

#include <vector>

#include "statics/simulation.h"

namespace endoflow::statics {

[[nodiscard]] inline bool is_vesicle(const Parameters& parameters) {
    return parameters.domain.kind == DomainKind::free_space;
}

/// The statics' own columns of history.csv for a vesicle.
[[nodiscard]] std::vector<ColumnText> vesicle_columns();

/// simulate() for a vesicle.
[[nodiscard]] ExitReason simulate_vesicle(const Parameters& parameters, const Request& request, RunOutput& output);

}  // namespace endoflow::statics
