#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "shared/numerics/forward.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// How molecules come onto the membrane and leave it: ∂_t (c dA) + … = j dA with
///     reservoir  j = k_on (1 − m/m_pool) (1 − c) − k_off c exp(s a₀ (∂e/∂c)/(k_B T))                     (Langmuir)
///     edge       j = v (1 − m/m_pool) √2 c (1 − c)/ε_c, 0 where c < 0: v |∂_s c| on the equilibrium profile of (24),
///                so that a flat coat's radius grows at v
/// m = ∫ c dA being what is on the membrane; what attaches is taken from a finite pool, m_pool. Where there are no
/// molecules the edge law must not make any: the state c = 0 is unstable under it.
class ExchangeLaw {
  public:
    /// Nothing is exchanged.
    ExchangeLaw() = default;
    explicit ExchangeLaw(const MoleculeParameters& molecules);

    [[nodiscard]] bool none() const { return kind_ == Exchange::none; }

    /// j [1/µs] at c, ∂e/∂c of bending at given curvature [pN/nm] and m [nm²].
    template <class Number>
    [[nodiscard]] Number rate(const Number& c, const Number& by_concentration, const Number& mass) const {
        if (none()) return Number(0.0);
        const Number left = 1.0 - per_pool_ * mass;
        if (kind_ == Exchange::edge) {
            if (value_of(c) < 0) return Number(0.0);
            return edge_rate_ * (left * (c * (1.0 - c)));
        }
        const double boost = std::exp(sensing_ * value_of(by_concentration));
        const Number leaving = chain(by_concentration, boost, sensing_ * boost, sensing_ * sensing_ * boost);
        return on_rate_ * (left * (1.0 - c)) - off_rate_ * (c * leaving);
    }

    /// Energy per molecule in units of k_B T that a coat on the flat membrane frees by leaving, 0 without sensing.
    [[nodiscard]] double detachment_exponent(double by_concentration) const { return sensing_ * by_concentration; }

  private:
    Exchange kind_ = Exchange::none;
    double on_rate_ = 0, off_rate_ = 0;  // 1/µs
    double edge_rate_ = 0;               // √2 v/ε_c, 1/µs
    double sensing_ = 0;                 // s a₀/(k_B T), nm/pN
    double per_pool_ = 0;                // 1/m_pool, 1/nm²; 0: unlimited
};

/// Throws InputError where an engine has no exchange of molecules and a case asks for it.
void require_no_exchange(const Parameters& parameters, const std::string& engine);

}  // namespace endoflow
