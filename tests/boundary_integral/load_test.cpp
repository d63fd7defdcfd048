// Loads and exchange: the work they do, and that nothing is left of them where they vanish.

#include <catch2/catch.hpp>
#include <numbers>

#include "boundary_integral/evolution/observation.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using endoflow::boundary_integral::testing::bulge;

using std::numbers::pi;

struct LoadCase {
    const char* name;
    Parameters parameters;
};

Parameters unloaded(int elements) {
    Parameters parameters;
    parameters.boundary_integral.elements = elements;
    return parameters;
}

// The standard case under one load each.
std::vector<LoadCase> single_loads(int elements, double rim_tension, double pressure, double force) {
    LoadCase tension{"rim tension", unloaded(elements)}, push{"pressure", unloaded(elements)},
        pull{"pole force", unloaded(elements)}, coat{"force on the coat", unloaded(elements)},
        ring{"force on the coat, held by a ring", unloaded(elements)}, collar{"collar", unloaded(elements)};
    tension.parameters.membrane.rim_tension = rim_tension;
    push.parameters.fluid.pressure_difference = pressure;
    pull.parameters.membrane.pole_force = force;
    coat.parameters.membrane.coat_force = ring.parameters.membrane.coat_force = force;
    ring.parameters.membrane.coat_force_ring = {40, 70};
    collar.parameters.membrane.collar_force = force;
    collar.parameters.membrane.collar_position = 45;
    return {tension, push, pull, coat, ring, collar};
}

// −σ A + p V + F z̄ + F_a (z̄_c − z̄_ring) − F_d r̄ of a curve, pN nm; heights and radii by the trapezoidal rule over the
// material's area from the pole.
double potential_of_loads(const Parameters& parameters, const MembraneSpace& space, const MembraneState& state) {
    const Loads loads = loads_of(parameters);
    const ShapeMeasures shape = measure_shape(space, state, parameters.domain);
    constexpr int steps = 20000;
    double area = 0, work = 0, coat = 0, lift = 0, slope_before = 0, pull_before = 0, c_before = 0, lift_before = 0;
    for (int i = 0; i <= steps; ++i) {
        const double xi = static_cast<double>(i) / steps;
        const CurvePoint p = curve_point(space.radial().basis(xi), space.axial().basis(xi), state);
        const double slope = 2 * pi * p.r * p.g;
        if (i > 0) area += (slope + slope_before) / (2 * steps);
        const double pull = (p.z * loads.material_force(area) + p.r * loads.radial_force(area)) * slope;
        const double c = space.axial().basis(xi).evaluate(state.c) * slope, c_lift = p.z * c;
        if (i > 0) {
            work += (pull + pull_before) / (2 * steps);
            coat += (c + c_before) / (2 * steps);
            lift += (c_lift + lift_before) / (2 * steps);
        }
        slope_before = slope, pull_before = pull, c_before = c, lift_before = c_lift;
    }
    return -loads.rim_tension * shape.membrane_area + loads.pressure * shape.extracellular_volume + work +
           loads.coat_force * lift / coat;
}

Eigen::VectorXd bulged(const MembraneDynamics& dynamics) {
    return dynamics.packed(bulge(dynamics.space(), 25));
}

}  // namespace

// What history.csv calls load_power is formed from the velocities; here it is what the curve's own A, V and z̄ gain
// while it moves. Membrane that flows in at the rim takes no part in p V and F z̄, and is σ A.
TEST_CASE("every load's power is the rate of the work done on the membrane", "[loads]") {
    for (const LoadCase& loaded : single_loads(48, 0.5, 0.02, 50)) {
        CAPTURE(loaded.name);
        Parameters parameters = loaded.parameters;
        // z̄_c varies by motion alone where the molecules stay in the material.
        if (parameters.membrane.coat_force != 0) parameters.molecules.transport = Transport::advection;
        const MembraneDynamics dynamics(parameters);
        const Eigen::VectorXd y = bulged(dynamics);
        const Evaluation e = dynamics.evaluate(0, y);
        const double step = 1e-3 / e.rate.head(dynamics.size() - dynamics.space().axial_count()).cwiseAbs().maxCoeff();
        const auto potential = [&](double time) {
            return potential_of_loads(parameters, dynamics.space(), dynamics.unpack(y + time * e.rate));
        };
        const double rate = (potential(step) - potential(-step)) / (2 * step);
        CHECK(rate == Approx(energy_balance(dynamics, e).external_power).epsilon(1e-5));
    }
}

// dE/dt along the computed motion, maturation included, against a difference of energies in time.
TEST_CASE("the power of maturation is what an older coat's energy is the larger by", "[loads]") {
    for (const Maturation law : {Maturation::exponential, Maturation::cooperative}) {
        Parameters parameters = unloaded(48);
        parameters.molecules.maturation = law;
        parameters.molecules.maturation_rate = 50;
        parameters.molecules.maturation_start = 0.2;
        const MembraneDynamics dynamics(parameters);
        const Eigen::VectorXd y = bulged(dynamics);
        constexpr double time = 0.01, step = 1e-5;
        const auto energy = [&](double at) { return energy_balance(dynamics, dynamics.evaluate(at, y)).energy; };
        const EnergyBalance balance = energy_balance(dynamics, dynamics.evaluate(time, y));
        const double rate = (energy(time + step) - energy(time - step)) / (2 * step);
        CHECK(rate == Approx(balance.maturation_power).epsilon(1e-6));  // (2 50 step)²/6 of it and less: E has χ²
        CHECK(balance.residual() < 1e-5);                               // as without maturation
        // The Jacobian is that of the rate at the same time.
        const Evaluation e = dynamics.evaluate(time, y);
        const Eigen::VectorXd direction = e.rate.normalized();
        constexpr double length = 1e-4;
        const auto rate_at = [&](double part) {
            return dynamics.evaluate(time, y + part * direction, e.operators).rate;
        };
        const Eigen::VectorXd difference = (rate_at(length) - rate_at(-length)) / (2 * length);
        CHECK((dynamics.jacobian(e) * direction - difference).norm() < 1e-5 * difference.norm());
    }
}

TEST_CASE("as loads and exchange vanish the unloaded motion is left", "[loads]") {
    const Parameters none = unloaded(24);
    const MembraneDynamics dynamics(none);
    const Eigen::VectorXd y = bulged(dynamics), rate = dynamics.evaluate(0, y).rate;
    std::vector<LoadCase> cases = single_loads(24, 1e-12, 1e-14, 1e-10);  // of some pN/nm, 0.1 pN/nm², 100 pN that move
    LoadCase reservoir{"reservoir", none}, edge{"edge", none};
    reservoir.parameters.molecules.exchange = Exchange::reservoir;
    reservoir.parameters.molecules.on_rate = reservoir.parameters.molecules.off_rate = 1e-12;
    edge.parameters.molecules.exchange = Exchange::edge;
    edge.parameters.molecules.edge_speed = 1e-12;
    cases.insert(cases.end(), {reservoir, edge});
    for (const auto& [name, parameters] : cases) {
        CAPTURE(name);
        const Eigen::VectorXd vanishing = MembraneDynamics(parameters).evaluate(0, y).rate;
        CHECK((vanishing - rate).norm() < 1e-10 * rate.norm());
    }
    // Where a load is 0 nothing reads the rest of its keys.
    Parameters zero = none;
    zero.membrane.pole_force_width = 20;
    CHECK(MembraneDynamics(zero).evaluate(0, y).rate == rate);
}
