#pragma once

#include <array>
#include <utility>

#include "phasefield/schemes/production/point_geometry.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::phasefield::production {

inline constexpr double moment_floor = constant("moment_floor");
inline constexpr double moment_alignment = constant("moment_alignment");

/// The membrane's energy as the layer carries it, with what its equations ask for at every point.
struct LayerEnergy {
    /// An energy without a part of the coat's edge.
    explicit LayerEnergy(const MembraneEnergy& whole) : LayerEnergy(whole, whole, {}) {}
    explicit LayerEnergy(const Parameters& parameters)
        : LayerEnergy(membrane_energy(parameters), bending_energy(parameters), line_energy(parameters)) {}

    MembraneEnergy density, bending, edge;  // E + E_c, and its parts
    double bare_stiffness;                  // ∂²e/∂κ² of the flat membrane without molecules [pN nm]
    bool coupled;  // knows ∇_Γ c: then δ(E + E_c)/δc drives the molecules and the membrane

    /// What compliance along the normal the last term of (D) has: D [nm²/(pN nm)].
    [[nodiscard]] double compliance(double epsilon) const {
        return moment_alignment * epsilon * epsilon / bare_stiffness;
    }
    [[nodiscard]] double smoothing(double epsilon) const { return moment_floor * epsilon / bare_stiffness; }

  private:
    LayerEnergy(MembraneEnergy whole, MembraneEnergy of_bending, MembraneEnergy of_edge)
        : density(std::move(whole)),
          bending(std::move(of_bending)),
          edge(std::move(of_edge)),
          bare_stiffness(density.density(0, 0, 0).second[local::curvature][local::curvature]),
          coupled(density.density(0.1, 0.4, 0.02).partial[local::squared_gradient] != 0) {}
};

/// c as the energy sees it: c itself on [0, 1], bent smoothly to stay within a twentieth of it outside. A sharp limit
/// would switch derivatives on and off where c is 1 but for round-off, and Newton's method would not converge.
template <class Number>
Number limited_concentration(const Number& c) {
    constexpr double margin = constant("concentration_margin");
    const double value = value_of(c), edge = value < 0 ? 0 : 1;
    if (value >= 0 && value <= 1) return c;
    const double t = std::tanh((value - edge) / margin);
    return chain(c, edge + margin * t, 1 - t * t);
}

/// The membrane's elastic state where the moment is b and t·∇c is `slope`, t the tangent: with N = −n the layer's
/// moment is −∂e/∂κ. A double well that is part of the energy holds c by itself, and must not be bent.
template <class Number>
ElasticState<Number> elastic_state_at(const LayerEnergy& energy, const Number& b, const Number& c,
                                      const Number& slope) {
    if (!energy.coupled) return elastic_state<Number>(energy.density, -b, limited_concentration(c), 0.0);
    return elastic_state<Number>(energy.density, -b, c, slope * slope);
}

/// ∂e/∂c of bending alone [pN/nm], which molecules feel that come and go.
template <class Number>
Number bending_by_concentration(const LayerEnergy& energy, const ElasticState<Number>& elastic, const Number& c) {
    if (!energy.coupled) return elastic.by_concentration;
    const LocalJet jet = energy.bending.density(value_of(elastic.curvature), value_of(c), 0);
    return compose_partial(jet, local::concentration, std::array<Number, local::count>{elastic.curvature, c, 0.0});
}

/// The energy (D) per volume where it is stationary over b [pN/nm²].
inline double energy_per_volume(const AtPoint<double>& b, const AtPoint<double>& psi,
                                const ElasticState<double>& elastic, double weight, double epsilon,
                                const LayerEnergy& energy) {
    const double slope = psi.r * b.r + psi.z * b.z;
    return weight * (elastic.density + 0.5 * energy.compliance(epsilon) * slope * slope) +
           0.5 * energy.smoothing(epsilon) * (b.r * b.r + b.z * b.z);
}

}  // namespace endoflow::phasefield::production
