#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "shared/numerics/forward.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// What an energy per area may depend on at one point of the membrane.
template <class Number>
struct LocalShape {
    Number curvature;         // κ, total, 1/nm
    Number concentration;     // c
    Number squared_gradient;  // |∇_Γ c|², 1/nm²
};

/// Indices of the derivatives of a density. In the moment form m stands in the place of κ.
namespace local {
inline constexpr std::size_t curvature = 0, moment = 0, concentration = 1, squared_gradient = 2, count = 3;
}  // namespace local

using LocalJet = Jet<local::count>;

/// The membrane's energy E = ∫ Σ e_i(κ, c, |∇_Γ c|²) dA as a sum of terms. A term is a class with
///     template <class Number> Number density(const LocalShape<Number>&) const;      // pN/nm
/// written once: forces, moments, chemical potentials and their derivatives are derived from this text by all engines.
class MembraneEnergy {
  public:
    MembraneEnergy() = default;

    template <class Term>
    MembraneEnergy& add(Term term) {
        terms_.emplace_back([term = std::move(term)](const LocalShape<LocalJet>& x) { return term.density(x); });
        return *this;
    }

    /// Adds another energy's terms.
    MembraneEnergy& add(const MembraneEnergy& other) {
        terms_.insert(terms_.end(), other.terms_.begin(), other.terms_.end());
        return *this;
    }

    /// e with its first and second derivatives by κ, c and |∇_Γ c|².
    [[nodiscard]] LocalJet density(double curvature, double concentration, double squared_gradient) const;

    /// The Legendre transform e*(m, c, |∇_Γ c|²) = m κ − e with κ from ∂e/∂κ = m, found by Newton's method, exact after
    /// one step where e is quadratic in κ. With its derivatives: ∂e*/∂m = κ, ∂e*/∂c = −∂e/∂c, ∂e*/∂|∇c|² = −∂e/∂|∇c|².
    /// NaN where an argument is none of the numbers; throws SolverError "no-curvature" when no κ has this moment.
    /// `near`: where the search for κ starts [1/nm].
    [[nodiscard]] LocalJet conjugate(double moment, double concentration, double squared_gradient,
                                     double near = 0) const;

  private:
    std::vector<std::function<LocalJet(const LocalShape<LocalJet>&)>> terms_;
};

/// The energy of a case, E + E_c, at a time [µs]: the list of the terms there are.
[[nodiscard]] MembraneEnergy membrane_energy(const Parameters& parameters, double time = 0);

/// Its parts alone: E of bending (S), and E_c of the coat's edge, which has no terms without energetic coupling.
[[nodiscard]] MembraneEnergy bending_energy(const Parameters& parameters, double time = 0);
[[nodiscard]] MembraneEnergy line_energy(const Parameters& parameters);

/// Whether bending and line energy drive the molecules and the line energy the membrane.
[[nodiscard]] bool energetically_coupled(const MoleculeParameters& molecules);

/// The membrane's elastic state at a moment m = ∂e/∂κ.
template <class Number>
struct ElasticState {
    Number curvature;            // κ, 1/nm
    Number density;              // e, pN/nm
    Number by_concentration;     // ∂e/∂c at given κ, pN/nm
    Number by_squared_gradient;  // ∂e/∂|∇_Γ c|², pN nm
};

template <class Number>
[[nodiscard]] ElasticState<Number> elastic_state(const MembraneEnergy& energy, const Number& moment, const Number& c,
                                                 const Number& squared_gradient) {
    const LocalJet jet = energy.conjugate(value_of(moment), value_of(c), value_of(squared_gradient));
    const std::array<Number, local::count> at{moment, c, squared_gradient};
    const Number curvature = compose_partial(jet, local::moment, at);
    return {curvature, moment * curvature - compose(jet, at), -compose_partial(jet, local::concentration, at),
            -compose_partial(jet, local::squared_gradient, at)};
}

}  // namespace endoflow
