#include "phasefield/driver/molecule_balance.h"

#include <cmath>
#include <cstddef>

#include "shared/numerics/lagrange.h"

namespace endoflow::phasefield {

namespace {

constexpr std::size_t most_rates = 4;

}  // namespace

void MoleculeBalance::start(double mass, double rate) {
    first_mass_ = mass;
    exchanged_ = put_right_ = 0;
    times_ = {0};
    rates_ = {rate};
}

void MoleculeBalance::advance(double time, double rate, double put_right) {
    put_right_ += std::abs(put_right);
    times_.insert(times_.begin(), time);
    rates_.insert(rates_.begin(), rate);
    if (times_.size() > most_rates) {
        times_.pop_back();
        rates_.pop_back();
    }
    // Simpson's rule is exact for cubics. Weights of times that are close to each other are large and cancel.
    const double before = times_[1];
    const std::vector<double> weights = lagrange_weights(times_, 0.5 * (before + time));
    double middle = rates_[1];
    for (std::size_t j = 0; j < weights.size(); ++j) middle += weights[j] * (rates_[j] - rates_[1]);
    exchanged_ += (time - before) / 6 * (rates_[1] + 4 * middle + rate);
}

double MoleculeBalance::residual(double mass) const {
    return (std::abs(mass - first_mass_ - exchanged_) + put_right_) / first_mass_;
}

}  // namespace endoflow::phasefield
