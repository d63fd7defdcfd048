#include "statics/point_equations.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "shared/model/initial_condition.h"

namespace endoflow::statics {

namespace {

/// ∫ c r dr over the flat membrane, nm².
double initial_mass(const Parameters& p) {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
    const auto integrand = [&](double r) { return initial_concentration(p.molecules, r) * r; };
    const double rim = p.domain.radius, width = 6 * p.molecules.interface_width;
    const double inner = std::clamp(p.molecules.patch_radius - width, 0.0, rim),
                 outer = std::clamp(p.molecules.patch_radius + width, 0.0, rim);
    double sum = Quadrature::integrate(integrand, inner, outer, 10, 1e-14);
    if (inner > 0) sum += Quadrature::integrate(integrand, 0.0, inner, 10, 1e-14);
    if (outer < rim) sum += Quadrature::integrate(integrand, outer, rim, 10, 1e-14);
    return sum;
}

}  // namespace

Material material_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    return {stationary.energy, p.molecules, loads_of(p), molecules_are_frozen(p), {}};
}

Setting setting_of(const StationaryCase& stationary) {
    const Parameters& p = stationary.parameters;
    const bool frozen = molecules_are_frozen(p);
    return {material_of(stationary),
            transport_law(p.molecules),
            p.domain.radius,
            p.domain.membrane_height,
            frozen ? 0.0 : initial_mass(p),
            frozen ? state::frozen_states : state::equilibrium_states,
            frozen ? 1 : 2};
}

Setting setting_of(const ClosedMembrane& membrane) {
    return {{{}, {}, {}, true, membrane}, {}, 0, 0, 0, state::closed_states, 1};
}

}  // namespace endoflow::statics
