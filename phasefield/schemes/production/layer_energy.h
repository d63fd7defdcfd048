#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "phasefield/layer/weights.h"
#include "phasefield/schemes/production/point_geometry.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::phasefield::production {

inline constexpr double moment_floor = constant("moment_floor");
inline constexpr double alignment = constant("alignment");
inline constexpr double strong_alignment = constant("strong_alignment");
inline constexpr double steepest_sheets = constant("steepest_sheets");

/// The membrane's energy as the layer carries it, with what its equations ask for at every point.
struct LayerEnergy {
    /// An energy without a part of the coat's edge.
    LayerEnergy(const MembraneEnergy& whole, bool knows_gradient) : LayerEnergy(whole, whole, {}, knows_gradient) {}
    /// A case's at a time [µs].
    explicit LayerEnergy(const Parameters& parameters, double time = 0)
        : LayerEnergy(membrane_energy(parameters, time), bending_energy(parameters, time), line_energy(parameters),
                      energetically_coupled(parameters.molecules)) {}

    MembraneEnergy density, bending, edge;  // E + E_c, and its parts
    double bare_stiffness;                  // β(0) = ∂²e/∂κ² of the flat membrane without molecules [pN nm]
    bool coupled;  // knows ∇_Γ c: then δ(E + E_c)/δc drives the molecules and the membrane

    /// D_m of (L) [nm²/(pN nm)].
    template <class Thickness>
    [[nodiscard]] Thickness compliance(const Thickness& epsilon) const {
        return (alignment / bare_stiffness) * epsilon * epsilon;
    }
    /// Continues m where δ_E is next to nothing.
    [[nodiscard]] double smoothing(double epsilon) const { return moment_floor * epsilon / bare_stiffness; }

  private:
    LayerEnergy(MembraneEnergy whole, MembraneEnergy of_bending, MembraneEnergy of_edge, bool knows_gradient)
        : density(std::move(whole)),
          bending(std::move(of_bending)),
          edge(std::move(of_edge)),
          bare_stiffness(density.density(0, 0, 0).second[local::curvature][local::curvature]),
          coupled(knows_gradient) {}
};

/// c as the energy sees it: c itself on [0, 1], bent smoothly to stay within a twentieth of it outside. A sharp limit
/// would switch derivatives on and off where c is 1 but for round-off, and Newton's method would not converge.
template <class Number>
Number limited_concentration(const Number& c) {
    constexpr double margin = constant("concentration_margin");
    const double value = value_of(c), edge = value < 0 ? 0 : 1;
    if (value >= 0 && value <= 1) return c;
    const double t = std::tanh((value - edge) / margin), slope = 1 - t * t;
    return chain(c, edge + margin * t, slope, -2 / margin * t * slope);
}

/// Where the energy of one of the layer's sheets is asked for.
template <class Number>
struct SheetPoint {
    Number p, c, squared_gradient;  // p = −m [pN], c, |∂ₜc|² [1/nm²]
    Number k;  // ε k, k = −∂_rψ/r the membrane's curvature around the axis, as sheets have it
};

template <class Number>
SheetPoint<double> values_of(const SheetPoint<Number>& x) {
    return {value_of(x.p), value_of(x.c), value_of(x.squared_gradient), value_of(x.k)};
}

/// At radius r, where c changes by `along` along the sheet [1/nm]. A double well that is part of the energy holds c by
/// itself, and must not be bent. Where layers meet on the axis k has no bound; thinning keeps ε k below a tenth where
/// it means anything.
template <class Number, class Thickness>
SheetPoint<Number> sheet_point(const LayerEnergy& energy, const Number& m, const Number& c, const Number& along,
                               const Number& psi_r, double r, const Thickness& epsilon) {
    const Number k = (-1 / r) * (epsilon * psi_r);
    const ValueAndDerivatives bound = bounded(value_of(k), steepest_sheets);
    return {-1.0 * m, energy.coupled ? c : limited_concentration(c), energy.coupled ? along * along : Number(0.0),
            chain(k, bound.value, bound.first, bound.second)};
}

/// e*_ε, the Legendre transform of the energy per area as the layer has it:
///
///   e*_ε(p, c) = e*(q, c) + M₂ k² e*(p, c),   q = p − M₂ k e*(p, c).
///
/// Sheets at the distance ψ have the area (1 + κ₁ψ)(1 + κ₂ψ), so that with e* itself the layer's energy per area would
/// be e + M₂ κ₁κ₂ (e − κ ∂e/∂κ). With e*_ε, which is e* (1 − M₂ κ₁κ₂) because ∂e*/∂p = κ₁ + κ₂ and k = κ₂, it is e up
/// to ε⁴. The membrane's moment is q.
class SheetEnergy {
  public:
    /// e* at the two moments of a point: what its derivatives of all kinds are made from.
    SheetEnergy(const LayerEnergy& energy, const SheetPoint<double>& x, double epsilon)
        : at_p_(energy.density.conjugate(x.p, x.c, x.squared_gradient)),
          at_q_(at_moment(energy, x, x.p - shift(x, epsilon) * at_p_.value)) {}

    /// e*_ε [pN/nm] at the same point in any numbers.
    template <class Number, class Thickness>
    [[nodiscard]] Number conjugate(const SheetPoint<Number>& x, const Thickness& epsilon) const {
        const Number at_p = compose(at_p_, std::array{x.p, x.c, x.squared_gradient});
        const Number q = x.p - shift(x, epsilon) * at_p;
        return compose(at_q_, std::array{q, x.c, x.squared_gradient}) + energy_second_moment * x.k * x.k * at_p;
    }
    /// e_c = ∂e/∂c of the membrane [pN/nm].
    template <class Number, class Thickness>
    [[nodiscard]] Number by_concentration(const SheetPoint<Number>& x, const Thickness& epsilon) const {
        const Number q = x.p - shift(x, epsilon) * compose(at_p_, std::array{x.p, x.c, x.squared_gradient});
        return -1.0 * compose_partial(at_q_, local::concentration, std::array{q, x.c, x.squared_gradient});
    }

  private:
    /// e* at q, its κ sought from where at_p_ puts it: there it is where e is quadratic in κ.
    [[nodiscard]] LocalJet at_moment(const LayerEnergy& energy, const SheetPoint<double>& x, double q) const {
        const double curvature = at_p_.partial[local::moment];
        const double compliance = at_p_.second[local::moment][local::moment];
        return energy.density.conjugate(q, x.c, x.squared_gradient, curvature + compliance * (q - x.p));
    }
    /// M₂ k
    template <class Number, class Thickness>
    [[nodiscard]] static Number shift(const SheetPoint<Number>& x, const Thickness& epsilon) {
        return energy_second_moment * epsilon * x.k;
    }

    LocalJet at_p_, at_q_;  // in this order
};

/// The membrane's elastic state as one sheet of the layer has it.
struct SheetState {
    double curvature;         // κ = ∂e*_ε/∂p [1/nm]
    double density;           // p κ − e*_ε [pN/nm]
    double by_concentration;  // e_c [pN/nm]
};
inline SheetState sheet_state(const LayerEnergy& energy, const SheetPoint<double>& x, double epsilon) {
    const SheetEnergy sheet(energy, x, epsilon);
    const auto conjugate =
        sheet.conjugate(SheetPoint<Dual<1>>{Dual<1>::variable(x.p, 0), x.c, x.squared_gradient, x.k}, epsilon);
    const double curvature = conjugate.partial[0];
    return {curvature, x.p * curvature - conjugate.value, sheet.by_concentration(x, epsilon)};
}

/// ∂e/∂c of bending alone [pN/nm], which molecules feel that come and go, where that of all is e_c.
template <class Number>
Number bending_by_concentration(const LayerEnergy& energy, const Number& curvature, const Number& e_c,
                                const Number& c) {
    if (!energy.coupled) return e_c;
    const LocalJet jet = energy.bending.density(value_of(curvature), value_of(c), 0);
    return compose_partial(jet, local::concentration, std::array<Number, local::count>{curvature, c, 0.0});
}

}  // namespace endoflow::phasefield::production
