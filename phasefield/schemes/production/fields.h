#pragma once

#include <array>

#include "phasefield/contour/cell_contour.h"
#include "phasefield/fem/space.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

/// Unknowns of the production scheme, all solved for together.
enum Field : unsigned int {
    velocity_r,
    velocity_z,
    pressure,            // p without the layer's own part δ q [pN/nm²]
    pressure_layer,      // q [pN/nm]
    tension,             // λ [pN/nm]
    distance,            // ψ [nm], φ = tanh(ψ/(√2 ε))
    normal_force,        // G, the variation of the energy per area, δ G = δE/δψ [pN/nm²]
    moment,              // b = β K [pN]
    molecule_density,    // c
    molecule_potential,  // μ
    membrane_stretch,    // s
};
inline constexpr unsigned int n_fields = 11;

/// One field and its derivatives at one point; also one row of a weak form: the factors of the test function and of its
/// derivatives.
template <class Number>
struct AtPoint {
    Number value{}, r{}, z{};
};
template <class Number>
using Fields = std::array<AtPoint<Number>, n_fields>;

/// Polynomial degrees in the order of Field.
std::vector<unsigned int> field_degrees(const PhaseFieldParameters& parameters);

/// Where the membrane and the fields on it are found.
ContourFields contour_fields(const Space& space, const Vector& solution);

/// Closes the constraints (values of the increments): u_r = 0 on the axis; on r = R s = 1, u_z = 0 in the pin band, ψ
/// fixed and no G across the whole layer. λ = 0 at the rim is natural. Without flow (geometric dynamics) u, p and λ are
/// switched off; without inextensibility λ is.
void close_constraints(Space& space, const Parameters& parameters);

/// Sets those values: extrapolation in time would let the smallest deviation grow.
void impose_boundary_values(const Space& space, const Parameters& parameters, Vector& vector);

}  // namespace endoflow::phasefield::production
