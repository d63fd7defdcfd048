#pragma once

#include <string>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Elements of the sharp engine, were they equally long, across the length ε_c of the coat's edge. Figures are exact to
/// 0.1 % from 1 on; below a half, concentrations overshoot and results are off by per cents.
[[nodiscard]] double elements_per_edge_width(const Parameters& parameters);

/// Below so many elements, c leaves [0, 1] beside the edge because of the mesh and not because of the law.
inline constexpr double fewest_elements_per_edge_width = 0.5;

/// What a case's resolution lets expect, foreseen without running it.
struct ResolutionWarning {
    std::string engine;
    std::string what;    // is too coarse
    std::string remedy;  // what to change
};

[[nodiscard]] std::vector<ResolutionWarning> foreseen_inaccuracies(const Parameters& parameters);

}  // namespace endoflow
