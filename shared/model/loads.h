#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "shared/numerics/forward.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// What pulls and pushes at the membrane from outside: a stationary shape makes stationary
///     G = E + σ A − p V − F z̄,   V = ∫ (z − z_rim) 2πr dr,   z̄ = ∫ z exp(−a/(πw²)) da/(πw²).
/// The pole force rides on the material: a is the membrane's area between the pole and a point.
struct Loads {
    double rim_tension;  // σ, pN/nm
    double pressure;     // p, extracellular minus intracellular, pN/nm²; > 0 pushes the bud into the cell
    double pole_force;   // F, pN; > 0 pulls into the cell
    double force_width;  // w, nm

    [[nodiscard]] bool none() const { return rim_tension == 0 && pressure == 0 && pole_force == 0; }

    /// The pole force's part exp(−a/(πw²))/(πw²) per area [1/nm²], as a function of a [nm²].
    template <class Number>
    [[nodiscard]] Number force_share(const Number& a) const {
        const double area = std::numbers::pi * force_width * force_width;
        const double share = std::exp(-value_of(a) / area) / area;
        return chain(a, share, -share / area, share / (area * area));
    }

    /// The part of the pole force that acts between the pole and a, 1 − exp(−a/(πw²)).
    template <class Number>
    [[nodiscard]] Number force_within(const Number& a) const {
        const double area = std::numbers::pi * force_width * force_width, inverse = 1 / area;
        const double beyond = std::exp(-value_of(a) * inverse);
        return chain(a, -std::expm1(-value_of(a) * inverse), beyond * inverse, -beyond * inverse * inverse);
    }
};

/// Throws InputError where an engine has neither the loads nor the coupling nor the exchange of molecules that a case
/// asks for.
void require_no_loads(const Parameters& parameters, const std::string& engine);

[[nodiscard]] inline Loads loads_of(const Parameters& parameters) {
    return {parameters.membrane.rim_tension, parameters.fluid.pressure_difference, parameters.membrane.pole_force,
            parameters.membrane.pole_force_width};
}

}  // namespace endoflow
