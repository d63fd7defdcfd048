#include "phasefield/schemes/production/equation_pattern.h"

#include <cstdint>
#include <iterator>

namespace endoflow::phasefield::production {

namespace pattern {

/// A set of columns, one bit each.
using Columns = std::uint64_t;

constexpr Columns value(Field field) {
    return Columns{1} << (3 * field);
}
constexpr Columns r(Field field) {
    return Columns{2} << (3 * field);
}
constexpr Columns z(Field field) {
    return Columns{4} << (3 * field);
}
constexpr Columns gradient(Field field) {
    return r(field) | z(field);
}
constexpr Columns all(Field field) {
    return value(field) | gradient(field);
}

constexpr Columns hessian = Columns{7} << n_features;                  // ∇∇ψ
constexpr Columns without_rz = hessian & ~(Columns{2} << n_features);  // its rr and zz, of the Laplacian
constexpr Columns u = value(velocity_r) | value(velocity_z);
constexpr Columns divergence = value(velocity_r) | r(velocity_r) | z(velocity_z);
constexpr Columns shear = z(velocity_r) | r(velocity_z);
constexpr Columns pressures = value(pressure) | value(pressure_layer);
constexpr Columns force =
    all(distance) | all(normal_force) | all(moment) | all(molecule_density) | value(molecule_potential) | hessian;
constexpr Columns normal_stress = divergence | pressures | value(tension) | all(distance);
constexpr Columns shear_stress = shear | value(tension) | all(distance);
constexpr Columns energy = all(distance) | value(moment) | all(molecule_density);
constexpr Columns turning = energy | gradient(normal_force) | gradient(moment) | without_rz;
constexpr Columns tilting = all(distance) | gradient(moment);
constexpr Columns flux_of_molecules =
    u | all(distance) | all(molecule_density) | gradient(molecule_potential) | gradient(membrane_stretch);
constexpr Columns potential = energy | gradient(molecule_potential);
constexpr Columns flux_of_membrane = u | all(distance) | all(membrane_stretch);
constexpr Columns along_normal_of_q = gradient(pressure_layer) | value(distance);
constexpr Columns along_normal_of_tension = gradient(tension) | value(distance);

/// What stands beside a test function of the field, its ∂r and its ∂z.
struct Contents {
    Field field;
    Columns value, r, z;
};

constexpr Contents contents[] = {
    {velocity_r, normal_stress | z(velocity_r) | value(velocity_z) | force, normal_stress, shear_stress},
    {velocity_z, u | gradient(velocity_z) | force, shear_stress, normal_stress},
    {pressure, divergence, 0, 0},
    {pressure_layer, divergence | value(pressure_layer) | value(distance), along_normal_of_q, along_normal_of_q},
    {tension, divergence | shear | all(distance) | value(membrane_stretch), along_normal_of_tension,
     along_normal_of_tension},
    {distance, u | all(distance) | value(normal_force), all(distance), all(distance)},
    {normal_force, energy | value(normal_force) | gradient(moment), turning, turning},
    {moment, energy, tilting, tilting},
    {molecule_density, energy, flux_of_molecules, flux_of_molecules},
    {molecule_potential, energy | value(molecule_potential), potential, potential},
    {membrane_stretch, value(distance) | value(membrane_stretch), flux_of_membrane, flux_of_membrane},
};

static_assert(std::size(contents) == n_fields);

}  // namespace pattern

std::vector<PatternEntry> equation_pattern() {
    std::vector<PatternEntry> entries;
    for (const auto& [field, of_value, of_r, of_z] : pattern::contents) {
        unsigned int row = 3 * field;
        for (const pattern::Columns columns : {of_value, of_r, of_z}) {
            for (unsigned int column = 0; column < n_variables; ++column)
                if ((columns >> column & 1) != 0) entries.push_back({row, column});
            ++row;
        }
    }
    return entries;
}

}  // namespace endoflow::phasefield::production
