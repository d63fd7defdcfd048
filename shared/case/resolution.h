#pragma once

#include <string>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// The sharp engine chooses no more elements than this: what needs more takes hours.
inline constexpr int most_elements = 320;

/// What the sharp engine's elements are chosen for: boundary_integral.accuracy, or what a stricter time.tolerance
/// would be a tenth of, at least 10⁻⁶.
[[nodiscard]] double accuracy_of_elements(const Parameters& parameters);

/// Elements with which the sharp engine begins where boundary_integral.elements is 0, whatever its initial state is
/// like: the shapes that are to come need them.
[[nodiscard]] int elements_asked_for(const Parameters& parameters);

/// time.tolerance of the sharp engine, a tenth of boundary_integral.accuracy where it is 0.
[[nodiscard]] double sharp_tolerance(const Parameters& parameters);

/// What a case's resolution lets expect, foreseen without running it.
struct ResolutionWarning {
    std::string engine;
    std::string what;    // is too coarse
    std::string remedy;  // what to change
};

[[nodiscard]] std::vector<ResolutionWarning> foreseen_inaccuracies(const Parameters& parameters);

}  // namespace endoflow
