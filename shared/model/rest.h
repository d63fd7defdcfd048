#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Below what a case's membrane is at rest. Its powers and speeds are then round-off, and so would be every measure of
/// accuracy relative to them: such measures divide by these at least, see rest_floor().
struct RestLevel {
    double energy = 0;  ///< pN nm: β, largest_stiffness(). A sphere has 8πβ
    double power = 0;  ///< pN nm/µs: 10⁻⁷ β/T, T being structure_time(). It takes 10⁷ T to change the energy by β
    double force = 0;   ///< pN: 10⁻⁷ β/L, L being length_of_structure()
    double speed = 0;   ///< nm/µs: 10⁻⁷ L/T
    double length = 0;  ///< nm: L
    double area = 0;    ///< nm², of coat: π ε_c². A smaller one is all edge

    [[nodiscard]] double area_rate() const { return speed * length; }             ///< nm²/µs, of a surface
    [[nodiscard]] double volume_rate() const { return speed * length * length; }  ///< nm³/µs
};

[[nodiscard]] RestLevel rest_level(const Parameters& parameters);

/// What a measure of accuracy divides by: `now`, or a billionth of the largest value so far of the same run, or the
/// level of rest, whichever is largest. All are ≥ 0 and have the same unit.
[[nodiscard]] double rest_floor(double now, double largest_so_far, double level);

}  // namespace endoflow
