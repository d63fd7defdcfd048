#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "shared/numerics/forward.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// What pulls and pushes at the membrane from outside: a stationary shape makes stationary
///     G = E + σ A − p V − F z̄ − F_a (z̄_c − z̄_ring) + F_d r̄,   V = ∫ (z − z_rim) 2πr dr,
///     z̄ = ∫ z exp(−a/(πw²)) da/(πw²),   z̄_c = ∫ c z dA/∫ c dA,   z̄_ring = ∫ w(a) z da/∫ w da,   r̄ = ∫ r g(a) da.
/// Pole force, ring and collar ride on the material: a is the membrane's area between the pole and a point. The force
/// on the coat rides on its molecules, and z̄_c varies by the membrane's motion alone. In a ring between a₁ and a₂ w =
/// s⁴ (1 − s)⁴, s = (a − a₁)/(a₂ − a₁). In a collar g is the Gaussian around a_d whose standard deviation is w_d along
/// a neck as wide as `collar_radius`, 2π · 10 nm · w_d in area.
struct Loads {
    double rim_tension;          // σ, pN/nm
    double pressure;             // p, extracellular minus intracellular, pN/nm²; > 0 pushes the bud into the cell
    double pole_force;           // F, pN; > 0 pulls into the cell
    double force_width;          // w, nm
    double coat_force;           // F_a, pN; > 0 pulls into the cell
    std::array<double, 2> ring;  // a₁, a₂, nm²; both 0: the rim bears the coat's force
    double collar_force;         // F_d, pN; > 0 narrows
    double collar_width;         // w_d, nm
    double collar_place;         // a_d, nm²; 0: not known yet

    /// Of the neck that a collar without a place waits for, nm.
    static constexpr double collar_radius = 10;

    [[nodiscard]] bool none() const {
        return rim_tension == 0 && pressure == 0 && pole_force == 0 && coat_force == 0 && collar_force == 0;
    }
    [[nodiscard]] bool collar_waits() const { return collar_force != 0 && collar_place == 0; }
    /// Whether the membrane is pulled along r.
    [[nodiscard]] bool radial() const { return collar_force != 0 && collar_place != 0; }
    /// Whether the membrane is pulled along z.
    [[nodiscard]] bool vertical() const { return pole_force != 0 || coat_force != 0; }
    /// Whether the membrane itself is pulled, along r or z.
    [[nodiscard]] bool carried() const { return vertical() || radial(); }
    [[nodiscard]] bool has_ring() const { return ring[1] > 0; }
    /// Whether part of its pull rides on the material.
    [[nodiscard]] bool on_material() const { return pole_force != 0 || (coat_force != 0 && has_ring()) || radial(); }

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

    /// The ring's part per area w/∫w da [1/nm²]; zero without a ring.
    template <class Number>
    [[nodiscard]] Number ring_share(const Number& a) const {
        const double s = place_in_ring(value_of(a)), width = ring[1] - ring[0];
        if (s <= 0 || s >= 1) return chain(a, 0, 0, 0);
        const double u = s * (1 - s), slope = 1 - 2 * s, scale = 630 / width;
        return chain(a, scale * u * u * u * u, scale / width * 4 * u * u * u * slope,
                     scale / (width * width) * (12 * u * u * slope * slope - 8 * u * u * u));
    }

    /// The ring's part between the pole and a: 0 to 1; zero without a ring.
    template <class Number>
    [[nodiscard]] Number ring_within(const Number& a) const {
        const double s = has_ring() ? std::clamp(place_in_ring(value_of(a)), 0.0, 1.0) : 0.0;
        const double within = s * s * s * s * s * (126 + s * (-420 + s * (540 + s * (-315 + 70 * s))));
        const auto share = ring_share(Jet<1>::variable(value_of(a), 0));
        return chain(a, within, share.value, share.partial[0]);
    }

    /// Standard deviation of the collar, nm².
    [[nodiscard]] double collar_spread() const { return 2 * std::numbers::pi * collar_radius * collar_width; }

    /// The collar's part per area g [1/nm²], of a collar that has a place.
    template <class Number>
    [[nodiscard]] Number collar_share(const Number& a) const {
        const double spread = collar_spread(), x = (value_of(a) - collar_place) / spread;
        const double share = std::exp(-0.5 * x * x) / (std::sqrt(2 * std::numbers::pi) * spread);
        return chain(a, share, -x * share / spread, (x * x - 1) * share / (spread * spread));
    }

    /// What rides on the material, along r per area [pN/nm²]: the collar's force.
    template <class Number>
    [[nodiscard]] Number radial_force(const Number& a) const {
        return radial() ? -collar_force * collar_share(a) : chain(a, 0, 0, 0);
    }

    /// What rides on the material, along z per area [pN/nm²]: the pole force, and what the ring bears.
    template <class Number>
    [[nodiscard]] Number material_force(const Number& a) const {
        return pole_force * force_share(a) - coat_force * ring_share(a);
    }

    /// Its integral between the pole and a [pN].
    template <class Number>
    [[nodiscard]] Number material_force_within(const Number& a) const {
        return pole_force * force_within(a) - coat_force * ring_within(a);
    }

  private:
    /// s; outside of [0, 1] without a ring.
    [[nodiscard]] double place_in_ring(double a) const {
        return has_ring() ? (a - ring[0]) / (ring[1] - ring[0]) : -1.0;
    }
};

/// Throws InputError where an engine has neither the loads nor the coupling nor the exchange of molecules that a case
/// asks for.
void require_no_loads(const Parameters& parameters, const std::string& engine);

[[nodiscard]] Loads loads_of(const Parameters& parameters);

}  // namespace endoflow
