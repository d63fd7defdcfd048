#pragma once

#include <functional>

namespace endoflow::boundary_integral {

/// Whether the membrane's molecules are those that it had and those that have come since. What has come is integrated
/// from the states between the steps, to the integrator's order, not from the moments' own rates.
class MoleculeBalance {
  public:
    MoleculeBalance() = default;
    MoleculeBalance(double first_mass, double exchanged) : first_mass_(first_mass), exchanged_(exchanged) {}

    void start(double mass) { *this = {mass, 0.0}; }

    /// Adds ∫∫ j dA dt from `begin` to `end` µs; `rate` is ∫ j dA, nm²/µs.
    void advance(double begin, double end, const std::function<double(double time)>& rate);

    [[nodiscard]] double first_mass() const { return first_mass_; }  ///< ∫ c dA at t = 0, nm²
    [[nodiscard]] double exchanged() const { return exchanged_; }    ///< since then, nm²

    /// |mass − first mass − what has come| over the first mass, or over `floor` nm² where that is larger.
    [[nodiscard]] double residual(double mass, double floor) const;

  private:
    double first_mass_ = 0.0, exchanged_ = 0.0;
};

}  // namespace endoflow::boundary_integral
