#include "boundary_integral/driver/molecule_balance.h"

#include <cmath>

#include "shared/model/rest.h"
#include "shared/numerics/gauss_legendre.h"

namespace endoflow::boundary_integral {

void MoleculeBalance::advance(double begin, double end, const std::function<double(double time)>& rate) {
    static const QuadratureRule rule = gauss_legendre(3);  // degree 5, the integrator's highest order
    const double half = 0.5 * (end - begin);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        exchanged_ += half * rule.weights[i] * rate(begin + half * (1.0 + rule.nodes[i]));
}

double MoleculeBalance::residual(double mass, double floor) const {
    return std::abs(mass - first_mass_ - exchanged_) / rest_floor(first_mass_, 0.0, floor);
}

}  // namespace endoflow::boundary_integral
