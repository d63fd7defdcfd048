#pragma once

#include <string>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// How a coat's preferred curvature ages: C = χ(t) C(c). A coat that is stiff and flat when it forms and curves later,
/// because its lattice rearranges, has χ(0) < 1 (Mund et al., J. Cell Biol. 222, e202206038 (2023)).
class MaturationLaw {
  public:
    explicit MaturationLaw(const MoleculeParameters& molecules);

    /// Whether χ = 1 for all times.
    [[nodiscard]] bool none() const { return law_ == Maturation::none; }

    /// χ(t), t in µs: 1, or of dχ/dt = k (1 − χ): 1 − (1 − χ₀) exp(−k t), or of dχ/dt = k (1 − χ²): tanh(k t + artanh
    /// χ₀).
    [[nodiscard]] double maturity(double time) const;

    /// dχ/dt [1/µs].
    [[nodiscard]] double rate(double time) const;

  private:
    Maturation law_;
    double speed_, start_;  // k [1/µs], χ₀
};

/// Throws InputError where an engine has no maturation and a case asks for it.
void require_no_maturation(const Parameters& parameters, const std::string& engine);

}  // namespace endoflow
