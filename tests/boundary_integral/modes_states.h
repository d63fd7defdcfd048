#pragma once

// Base states that the tests of azimuthal modes share.

#include <cmath>
#include <numbers>

#include "boundary_integral/modes/base_state.h"
#include "curves.h"
#include "shared/model/bending_model.h"

namespace endoflow::boundary_integral::testing {

inline constexpr double sphere_radius = 20;  // nm

inline Parameters vesicle_parameters(double inner, double outer) {
    Parameters parameters;
    parameters.domain.kind = DomainKind::free_space;
    parameters.fluid.viscosity_extracellular = inner;
    parameters.fluid.viscosity_intracellular = outer;
    return parameters;
}

/// At rest, without a force.
inline BaseState at_rest(const MembraneSpace& space, MembraneState membrane) {
    BaseState base;
    base.membrane = std::move(membrane);
    base.velocity = Eigen::VectorXd::Zero(space.curve_count());
    base.force = Eigen::VectorXd::Zero(space.force_count());
    base.multipliers.tension = Eigen::VectorXd::Zero(space.tension().dimension());
    return base;
}

/// A bare sphere with the tension sigma beta/R^2, in equilibrium with its pressure: dE = lambda dA + p dV = 0.
inline BaseState sphere_at_rest(const MembraneSpace& space, const BendingModel& model, double sigma) {
    using std::numbers::pi;
    BaseState base =
        at_rest(space, state_of(
                           space, [](double x) { return sphere_radius * std::sin(pi * x); },
                           [](double x) { return sphere_radius * std::cos(pi * x); }, [](double) { return 0.0; }));
    const double tension = sigma * model.stiffness(0).value / (sphere_radius * sphere_radius);
    base.multipliers.tension.setConstant(tension);
    base.multipliers.pressure = -2 * tension / sphere_radius;
    return base;
}

}  // namespace endoflow::boundary_integral::testing
