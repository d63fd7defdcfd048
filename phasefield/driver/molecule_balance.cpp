#include "phasefield/driver/molecule_balance.h"

#include <cmath>
#include <cstddef>

namespace endoflow::phasefield {

namespace {

constexpr std::size_t most_rates = 4;

/// The polynomial through the values at the times.
double interpolated(const std::vector<double>& times, const std::vector<double>& values, double time) {
    double sum = 0;
    for (std::size_t j = 0; j < times.size(); ++j) {
        double weight = values[j];
        for (std::size_t m = 0; m < times.size(); ++m)
            if (m != j) weight *= (time - times[m]) / (times[j] - times[m]);
        sum += weight;
    }
    return sum;
}

}  // namespace

void MoleculeBalance::start(double mass, double rate) {
    first_mass_ = mass;
    exchanged_ = 0;
    times_ = {0};
    rates_ = {rate};
}

void MoleculeBalance::advance(double time, double rate) {
    times_.insert(times_.begin(), time);
    rates_.insert(rates_.begin(), rate);
    if (times_.size() > most_rates) {
        times_.pop_back();
        rates_.pop_back();
    }
    // Simpson's rule is exact for cubics.
    const double before = times_[1], middle = interpolated(times_, rates_, 0.5 * (before + time));
    exchanged_ += (time - before) / 6 * (rates_[1] + 4 * middle + rate);
}

double MoleculeBalance::residual(double mass) const {
    return std::abs(mass - first_mass_ - exchanged_) / first_mass_;
}

}  // namespace endoflow::phasefield
