#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// What the membrane's size is measured by [nm]: domain.radius, of a vesicle the longer semi-axis.
[[nodiscard]] double size_of_membrane(const DomainParameters& domain);

/// β [pN nm], the larger one of the bare and the coated membrane's.
[[nodiscard]] double largest_stiffness(const MembraneParameters& membrane);

/// The time [µs] in which a membrane that is bent over its size R relaxes: (ν₁ + ν₂) R³/β with fluids, R²
/// ε_c²/(M β) without (the coat's edge, ε_c wide, then decides), β being largest_stiffness and M
/// fluid.normal_mobility. 9.4 µs in the standard case.
[[nodiscard]] double natural_time(const Parameters& parameters);

/// The time [µs] in which molecules that come and go change the coat: 1/(k_on + k_off), or R/v at its edge. 0 without.
[[nodiscard]] double exchange_time(const Parameters& parameters);

/// time.initial_step, or where that is 0 about 10⁻⁶ of natural_time [µs].
[[nodiscard]] double first_step(const Parameters& parameters);

/// time.max_step, or where that is 0 about 0.02 of the longer one of natural_time and exchange_time [µs]: a membrane
/// that follows a slowly growing coat is at rest in between, and steps are as long as their error allows.
[[nodiscard]] double longest_step(const Parameters& parameters);

/// time.tolerance, or what an engine chooses where that is 0.
[[nodiscard]] double time_tolerance(const Parameters& parameters, double chosen);

}  // namespace endoflow
