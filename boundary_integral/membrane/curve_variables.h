#pragma once

// What densities on the membrane depend on at one point, and the basis functions' part in it.

#include <array>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/numerics/forward.h"

namespace endoflow::boundary_integral {

/// What the energy depends on at one point: the curve's derivatives, which alone make its geometry, then c and c'.
enum Variable : std::size_t { var_r, var_r1, var_r2, var_z1, var_z2, var_c, var_c1, variable_count };
inline constexpr std::size_t curve_variables = 5;
using CurveJet = Jet<curve_variables>;
using CurveDual = Dual<curve_variables>;
using EnergyJet = Jet<variable_count>;
using EnergyDual = Dual<variable_count>;

/// κ = -(r' z'' - z' r'')/g³ - z'/(r g), 1/g² and r g: what the energy per dξ, e(κ, c, c'²/g²) r g, has of
/// the curve. `Number` has at least the curve's variables.
template <class Number>
[[nodiscard]] std::array<Number, 3> geometry(const CurvePoint& p) {
    const Number r1 = Number::variable(p.r1, var_r1), z1 = Number::variable(p.z1, var_z1);
    const Number squared = r1 * r1 + z1 * z1, inverse = 1.0 / squared, root = sqrt(squared);
    const Number cross = r1 * Number::variable(p.z2, var_z2) - z1 * Number::variable(p.r2, var_r2);
    const Number area = Number::variable(p.r, var_r) * root;
    return {-(cross * inverse + z1 / Number::variable(p.r, var_r)) / root, inverse, area};
}

using Direction = std::array<double, variable_count>;

/// One basis function seen by the variables it moves: three of them from `first` on.
struct Slot {
    Index row;  // coefficient index in (r, z) or in c
    std::size_t first;
    std::array<double, 3> partial;  // d(variable)/d(coefficient)
};

struct LocalSlots {
    std::array<Slot, 12> curve;
    std::array<Slot, 6> concentration;
};

[[nodiscard]] inline LocalSlots local_slots(const BasisRow& radial, const BasisRow& axial, Index radial_count) {
    static_assert(var_r == 0 && var_z1 == 3 && var_c1 + 1 == variable_count);
    LocalSlots slots{};
    for (std::size_t j = 0; j < 6; ++j) {
        slots.curve[j] = {radial.index[j], var_r, {radial.value[0][j], radial.value[1][j], radial.value[2][j]}};
        slots.curve[6 + j] = {radial_count + axial.index[j], var_z1, {axial.value[1][j], axial.value[2][j], 0.0}};
        slots.concentration[j] = {axial.index[j], var_z2, {0.0, axial.value[0][j], axial.value[1][j]}};
    }
    return slots;
}

template <class Derivatives>
[[nodiscard]] double dot(const Derivatives& a, const Slot& slot) {
    return a[slot.first] * slot.partial[0] + a[slot.first + 1] * slot.partial[1] + a[slot.first + 2] * slot.partial[2];
}

}  // namespace endoflow::boundary_integral
