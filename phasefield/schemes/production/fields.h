#pragma once

#include <array>
#include <optional>
#include <vector>

#include "phasefield/contour/cell_contour.h"
#include "phasefield/fem/space.h"
#include "phasefield/layer/initial_membrane.h"
#include "shared/model/membrane_energy.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

/// Unknowns of the production scheme, all solved for together.
enum Field : unsigned int {
    velocity_r,
    velocity_z,
    pressure,            // p without the layer's own part δ p_Γ [pN/nm²]
    pressure_layer,      // p_Γ [pN/nm]
    tension,             // λ [pN/nm]
    distance,            // ψ [nm], φ = tanh(ψ/(√2 ε))
    normal_force,        // G, the variation of the energy per area, δ_Γ G = δE/δψ [pN/nm²]
    moment,              // m = −∂e/∂κ, β (C − κ) of bending alone [pN]
    molecule_density,    // c
    molecule_potential,  // μ
    membrane_stretch,    // s
    n_fields,            // how many there are
};

/// The others live on the membrane.
constexpr bool lives_in_fluid(unsigned int field) {
    return field == velocity_r || field == velocity_z || field == pressure;
}

/// One field and its derivatives at one point; also one row of a weak form: the factors of the test function and of its
/// derivatives.
template <class Number>
struct AtPoint {
    Number value{}, r{}, z{};
};
template <class Number>
using Fields = std::array<AtPoint<Number>, n_fields>;

/// By what the sizes of the fields are measured.
struct Scales {
    double length;     // L, length_of_structure [nm]
    double thickness;  // ε [nm]
    double speed;      // V = L/structure_time [nm/µs]
    double stiffness;  // β, the larger one [pN nm]
};
Scales scales(const Parameters& parameters);

/// All that is said of an unknown besides its equation. Absent functions: held nowhere, zero at first, always solved
/// for.
struct Unknown {
    Field field;
    const char* output_name;  // "velocity" twice: a vector's components
    unsigned int (*degree)(const PhaseFieldParameters&);
    double (*size)(const Scales&);  // in a membrane that is bent over L
    /// The value it is held at on a boundary, `above` the membrane's flat height [nm], if it is.
    std::optional<double> (*held)(dealii::types::boundary_id, double above, const Parameters&) = nullptr;
    double (*initial)(const InitialPoint&, const MembraneEnergy&) = nullptr;
    bool (*switched_off)(const Parameters&) = nullptr;
};

/// c and μ of molecules that the energy does not drive: the membrane carries them along. Within a step they and the
/// other fields feel each other so little that they are solved for in turn.
bool carried_along(unsigned int field, const Parameters& parameters);

/// In the order of Field; the space, its constraints, the start, the solver and the output read this table.
const std::array<Unknown, n_fields>& unknowns();

/// Polynomial degrees in the order of Field.
std::vector<unsigned int> field_degrees(const PhaseFieldParameters& parameters);

/// The membrane with its patch of molecules at rest.
Vector initial_fields(const Space& space, const Parameters& parameters, const MembraneEnergy& energy);

/// Where the membrane and the fields on it are found.
ContourFields contour_fields(const Space& space, const Vector& solution);

/// Closes the constraints (values of the increments): what is held at boundaries and what is switched off.
void close_constraints(Space& space, const Parameters& parameters);

/// Sets those values: extrapolation in time would let the smallest deviation grow.
void impose_boundary_values(const Space& space, const Parameters& parameters, Vector& vector);

}  // namespace endoflow::phasefield::production
