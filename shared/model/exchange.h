#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>

#include "shared/numerics/forward.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// What the exchange of molecules may depend on at one point of the membrane.
template <class Number>
struct ExchangePoint {
    Number concentration;     // c
    Number by_concentration;  // ∂e/∂c of bending at given curvature, pN/nm
    Number mass;              // m = ∫ c dA, what is on the whole membrane, nm²
    Number bulk;              // c_b/c_∞ of the fluid at the membrane, 1 where nothing is depleted
};

/// How molecules come onto the membrane and leave it: ∂_t (c dA) + … = j dA. A law is a class with
///     template <class Number> Number rate(const ExchangePoint<Number>&) const;      // j, 1/µs
/// written once: its derivatives are derived from this text by all engines.
class ExchangeLaw {
  public:
    /// Nothing is exchanged.
    ExchangeLaw() = default;
    template <class Law>
    explicit ExchangeLaw(Law law)
        : rate_([law = std::move(law)](const ExchangePoint<RateJet>& x) { return law.rate(x); }) {}

    [[nodiscard]] bool none() const { return !rate_; }

    /// j with its derivatives as far as Number carries them.
    template <class Number>
    [[nodiscard]] Number rate(const Number& c, const Number& by_concentration, const Number& mass,
                              const Number& bulk = Number(1.0)) const {
        if (none()) return Number(0.0);
        const RateJet jet = rate_({RateJet::variable(value_of(c), 0), RateJet::variable(value_of(by_concentration), 1),
                                   RateJet::variable(value_of(mass), 2), RateJet::variable(value_of(bulk), 3)});
        return compose(jet, std::array<Number, 4>{c, by_concentration, mass, bulk});
    }

  private:
    using RateJet = Jet<4>;
    std::function<RateJet(const ExchangePoint<RateJet>&)> rate_;
};

/// The law of a case.
[[nodiscard]] ExchangeLaw exchange_law(const MoleculeParameters& molecules);

/// Energy in units of k_B T that a molecule frees by leaving where ∂e/∂c is `by_concentration` [pN/nm], 0 without
/// sensing.
[[nodiscard]] double detachment_exponent(const MoleculeParameters& molecules, double by_concentration);

/// Throws InputError where an engine has no exchange of molecules and a case asks for it.
void require_no_exchange(const Parameters& parameters, const std::string& engine);

/// The same for a bulk that is depleted.
void require_no_bulk(const Parameters& parameters, const std::string& engine);

}  // namespace endoflow
