#include "shared/model/maturation.h"

#include <cmath>

#include "shared/support/error.h"

namespace endoflow {

MaturationLaw::MaturationLaw(const MoleculeParameters& molecules)
    : law_(molecules.maturation), speed_(molecules.maturation_rate), start_(molecules.maturation_start) {}

double MaturationLaw::maturity(double time) const {
    switch (law_) {
        case Maturation::none:
            return 1;
        case Maturation::exponential:
            return 1 - (1 - start_) * std::exp(-speed_ * time);
        case Maturation::cooperative:
            return start_ < 1 ? std::tanh(speed_ * time + std::atanh(start_)) : 1;
    }
    throw InputError("molecules.maturation: not a law");
}

double MaturationLaw::rate(double time) const {
    const double chi = maturity(time);
    return none() ? 0 : speed_ * (1 - (law_ == Maturation::cooperative ? chi * chi : chi));
}

void require_no_maturation(const Parameters& parameters, const std::string& engine) {
    if (parameters.molecules.maturation == Maturation::none) return;
    throw InputError("molecules.maturation must be none: the " + engine + " does not have another one");
}

}  // namespace endoflow
