#pragma once

#include <vector>

namespace endoflow::phasefield {

/// Whether the membrane's molecules are those that it had and those that have come since. What has come is the integral
/// of the cubic through the last four rates, whatever the scheme makes of them.
class MoleculeBalance {
  public:
    /// At the start: ∫ c dA [nm²] and ∫ j dA [nm²/µs].
    void start(double mass, double rate);
    /// The rate at the end of a step [nm²/µs], time in µs; what the step has put right [nm²] is no exchange.
    void advance(double time, double rate, double put_right);

    [[nodiscard]] double exchanged() const { return exchanged_; }  // since the start [nm²]
    /// |mass − first mass − what has come|, and what was put right, over the first mass.
    [[nodiscard]] double residual(double mass) const;

    template <class Archive>
    void serialize(Archive&& archive) {
        archive("first_molecule_mass", first_mass_);
        archive("molecules_exchanged", exchanged_);
        archive("molecules_put_right", put_right_);
        archive("exchange_times", times_);
        archive("exchange_rates", rates_);
    }

  private:
    double first_mass_ = 0, exchanged_ = 0, put_right_ = 0;  // put_right_: moduli
    std::vector<double> times_, rates_;                      // newest first
};

}  // namespace endoflow::phasefield
