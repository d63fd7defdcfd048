#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// β [pN nm], the larger one of the bare and the coated membrane's.
[[nodiscard]] double largest_stiffness(const MembraneParameters& membrane);

/// The length L [nm] of what forms, whatever the box around it: the smallest one of
///   2/|C|       the radius of the sphere that the coat prefers, C its spontaneous curvature
///   √(β/2|σ|)   the radius of a tube under the rim's tension σ (Derényi, Jülicher & Prost 2002)
///   2πβ/|F|     the radius of a tube that the pole force F pulls
///   ∛(β/|p|)    where the pressure p bends the membrane
///   r_c/2       the radius of the sphere into which line energy closes a patch of radius r_c
/// as far as there are such, and domain.radius; of a vesicle the shorter semi-axis instead of it. β is
/// largest_stiffness. 14.1 nm in the standard case.
[[nodiscard]] double length_of_structure(const Parameters& parameters);

/// The time [µs] in which a membrane that is bent over a length ℓ relaxes: (ν₁ + ν₂) ℓ³/β with fluids, ℓ² ε_c²/(M β)
/// without (the coat's edge, ε_c wide, then decides), β being largest_stiffness and M fluid.normal_mobility.
[[nodiscard]] double relaxation_time(const Parameters& parameters, double length);

/// T, the relaxation_time over length_of_structure: 0.051 µs in the standard case.
[[nodiscard]] double structure_time(const Parameters& parameters);

/// The time [µs] in which molecules that come and go change the coat: 1/(k_on + k_off), or L/v at its edge, L being
/// length_of_structure. 0 without.
[[nodiscard]] double exchange_time(const Parameters& parameters);

/// time.initial_step, or where that is 0 about 2·10⁻⁴ of structure_time [µs].
[[nodiscard]] double first_step(const Parameters& parameters);

/// time.max_step, or where that is 0 about 4 times structure_time, or 0.02 of exchange_time where that is longer [µs]:
/// for an engine whose own control of steps needs a bound. The sharp engine's does not.
[[nodiscard]] double longest_step(const Parameters& parameters);

/// The part of its allowed error that a step at this time may have, ∛(t/T) with T the structure_time, between 0.1 and
/// 1: what has formed by then is smaller.
[[nodiscard]] double early_part(double time, const Parameters& parameters);

/// time.tolerance, or what an engine chooses where that is 0.
[[nodiscard]] double time_tolerance(const Parameters& parameters, double chosen);

}  // namespace endoflow
