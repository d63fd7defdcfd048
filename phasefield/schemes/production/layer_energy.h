#pragma once

#include <array>
#include <utility>

#include "phasefield/schemes/production/layer_weights.h"
#include "phasefield/schemes/production/point_geometry.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::phasefield::production {

inline constexpr double moment_floor = constant("moment_floor");
inline constexpr double moment_alignment = constant("moment_alignment");
inline constexpr double potential_alignment = constant("potential_alignment");
inline constexpr double steepest_sheets = constant("steepest_sheets");

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

/// The membrane's curvature around the axis as the layer's sheets have it, for the correction below.
template <class Number>
struct SheetCurvature {
    Number scaled;        // y = ε k, k = −ψ_r/r, at most steepest_sheets [1]
    Number slope;         // ∂y/∂ψ_r
    Number by_thickness;  // ∂y/∂ε [1/nm]
};

/// At radius r [nm]. Where layers meet on the axis k has no bound; thinning keeps ε k below a tenth where it means
/// anything.
template <class Number>
SheetCurvature<Number> sheet_curvature(const Number& psi_r, double r, double epsilon) {
    const Number y = (-epsilon / r) * psi_r;
    const ValueAndDerivatives limited = bounded(value_of(y), steepest_sheets);
    const Number slope = chain(y, limited.first, limited.second);
    return {chain(y, limited.value, limited.first), (-epsilon / r) * slope, (1 / epsilon) * (slope * y)};
}

/// The membrane's elastic state as one sheet of the layer sees it.
template <class Number>
struct SheetState {
    ElasticState<Number> elastic;  // of e* below: κ = ∂e*/∂p, e = p κ − e*, and minus its other derivatives
    Number conjugate;              // e* of the layer [pN/nm]
    Number by_curvature;           // ∂e*/∂y
    Number by_thickness;           // ∂e*/∂ε at given y
    Number by_concentration;       // ∂e/∂c of the membrane, which the fluid feels [pN/nm]
};

/// Where the moment is b and t·∇c is `slope`, t the tangent: with N = −n the layer's moment is p = −b = ∂e/∂κ. A double
/// well that is part of the energy holds c by itself, and must not be bent.
///
/// Sheets at the distance ψ have the area (1 + κ₁ψ)(1 + κ₂ψ), so that with e* itself the layer's energy per area would
/// be e + M₂ κ₁κ₂ (e − κ ∂e/∂κ), M₂ = ∫ ψ² δ_E dψ. It is e up to ε⁴ with
///
///   e*(q) + M₂ k² e*(p),   q = p − M₂ k e*(p),   k = κ₂,
///
/// which is e* (1 − M₂ κ₁κ₂) because ∂e*/∂p = κ₁ + κ₂. The moment of the membrane is q.
template <class Number>
SheetState<Number> sheet_state(const LayerEnergy& energy, const Number& b, const Number& c, const Number& slope,
                               const Number& y, double epsilon) {
    const Number held = energy.coupled ? c : limited_concentration(c);
    const Number squared = energy.coupled ? slope * slope : Number(0.0);
    const Number p = -1.0 * b;
    const ElasticState<Number> plain = elastic_state<Number>(energy.density, p, held, squared);
    const Number plain_conjugate = p * plain.curvature - plain.density;
    const double m2 = energy_second_moment, m = m2 * epsilon;
    const Number shift = m * y, square = m2 * y * y;
    const Number q = p - shift * plain_conjugate;
    ElasticState<Number> state = elastic_state<Number>(energy.density, q, held, squared);
    const Number curvature = state.curvature, by_concentration = state.by_concentration;
    const Number conjugate = q * curvature - state.density + square * plain_conjugate;
    // −∂q/∂(e* of p) times κ of q, less what k² adds: of every derivative of e*(p)
    const Number part = shift * curvature - square;
    state.curvature = curvature - part * plain.curvature;
    state.by_concentration = by_concentration - part * plain.by_concentration;
    state.by_squared_gradient = state.by_squared_gradient - part * plain.by_squared_gradient;
    state.density = p * state.curvature - conjugate;
    return {state, conjugate, plain_conjugate * (2.0 * m2 * y - m * curvature), -m2 * (y * curvature * plain_conjugate),
            by_concentration};
}

/// ∂e/∂c of bending alone [pN/nm], which molecules feel that come and go.
template <class Number>
Number bending_by_concentration(const LayerEnergy& energy, const SheetState<Number>& sheet, const Number& c) {
    if (!energy.coupled) return sheet.by_concentration;
    const Number& curvature = sheet.elastic.curvature;
    const LocalJet jet = energy.bending.density(value_of(curvature), value_of(c), 0);
    return compose_partial(jet, local::concentration, std::array<Number, local::count>{curvature, c, 0.0});
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
