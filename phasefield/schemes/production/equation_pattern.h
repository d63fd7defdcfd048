#pragma once

#include <vector>

#include "phasefield/schemes/production/fields.h"

namespace endoflow::phasefield::production {

inline constexpr unsigned int n_features = 3 * n_fields;     // rows: what test functions multiply
inline constexpr unsigned int n_variables = n_features + 3;  // columns: besides, ψ's second derivatives

/// A row and a column of the Jacobian at a point, 3 × field + {value, ∂r, ∂z}; ψ's second derivatives come last.
struct PatternEntry {
    unsigned int row, column;
};

/// Which rows contain which fields, in one case or another, row by row.
std::vector<PatternEntry> equation_pattern();

}  // namespace endoflow::phasefield::production
