// Stationary shapes from the boundary-value problem of statics/, which shares no numerics with the engine, handed to
// the engine's flow: nothing may move, and tension and pressure must be those of the boundary-value problem.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/flow/box_flow.h"
#include "boundary_integral/flow/free_space_flow.h"
#include "boundary_integral/membrane/external_loads.h"
#include "curves.h"
#include "shared/geometry/observables.h"
#include "statics/sampled_curve.h"
#include "statics/stationary_state.h"
#include "statics/vesicle_state.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;

const statics::GaussRule rule(statics::Resolution{}.points);

double largest_speed(const MembraneSpace& space, const Eigen::VectorXd& velocity) {
    const Eigen::VectorXd u_r = velocity.head(space.radial_count()), u_z = velocity.tail(space.axial_count());
    double largest = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i)
        largest = std::max(largest, std::hypot(space.radial_rows[i].evaluate(u_r), space.axial_rows[i].evaluate(u_z)));
    return largest;
}

struct VesicleErrors {
    double speed;                      // over beta/(nu R^2)
    double tension, pressure, energy;  // relative
};

struct BudErrors {
    double speed, inflow;    // nm/us; a flat patch begins to move with some 500 nm/us
    double tension, energy;  // relative, to the largest tension
};

constexpr double vesicle_radius = 20;  // nm

statics::VesicleState vesicle(double reduced_volume, statics::VesicleFamily family) {
    // Without molecules it has no spontaneous curvature.
    const statics::ClosedMembrane sphere(membrane_energy(Parameters{}), 0, 4 * pi * vesicle_radius * vesicle_radius, 0);
    return statics::find_vesicle(statics::with_reduced_volume(sphere, reduced_volume), family);
}

// xi = u with x = sin^2(pi u/2) of the label x: r and z are smooth in it, with the parity of the splines at both poles.
VesicleErrors errors_of(const statics::VesicleState& exact, Index elements) {
    Parameters parameters;
    parameters.domain.kind = DomainKind::free_space;
    const MembraneSpace space(elements, 8, CurveEnd::closed);
    const auto at = [&](double u, Eigen::Index which) {
        return statics::evaluate(exact.solution, rule, std::pow(std::sin(0.5 * pi * u), 2))(which);
    };
    const MembraneState state = state_of(
        space, [&](double u) { return std::sqrt(std::max(at(u, statics::state::r_squared), 0.0)); },
        [&](double u) { return at(u, statics::state::height); }, [](double) { return 0.0; });
    const MembraneSamples samples = sample(space, state);
    const BendingModel model(parameters.membrane);
    const EnergyDerivatives energy = energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first);
    const FreeSpaceFlow model_of_flow(parameters, space);
    const FlowSolution flow = model_of_flow.solve(model_of_flow.operators(state, samples), samples, energy, 0);
    const double beta = exact.membrane.stiffness();
    const double speed = beta / (parameters.fluid.viscosity_intracellular * vesicle_radius * vesicle_radius);
    double tension = 0;
    for (const BasisRow& row : space.tension_rows)
        tension = std::max(tension, std::abs(row.evaluate(flow.multipliers.tension) - exact.tension()));
    return {largest_speed(space, flow.velocity) / speed, tension / std::abs(exact.tension()),
            std::abs(flow.multipliers.pressure / -exact.pressure() - 1),  // the multiplier counts outside minus inside
            std::abs(2 * pi * energy.energy / exact.bending_energy() - 1)};
}

// u(xi) on [0, 1], odd, with du/dxi about four times smaller near u = edge: xi ~ u + tanh((u - edge)/w) + tanh((u +
// edge)/w).
double crowded_at(double edge, double xi) {
    const double width = 0.06, amount = 0.25;
    const auto stretched = [&](double u) {
        return u + amount * (std::tanh((u - edge) / width) + std::tanh((u + edge) / width));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (stretched(middle) < xi * stretched(1) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

BudErrors errors_of(const statics::StationaryState& exact, Index elements) {
    const Parameters& parameters = exact.parameters;
    const MembraneSpace space(elements, 8);
    const auto& solution = exact.point.solution;
    const double edge = parameters.molecules.patch_radius / std::sqrt(2 * solution.globals(statics::global::area));
    const auto at = [&](double xi, Eigen::Index which) {
        return statics::evaluate(solution, rule, std::pow(crowded_at(edge, xi), 2))(which);
    };
    const MembraneState state = state_of(
        space, [&](double u) { return std::sqrt(std::max(at(u, statics::state::r_squared), 0.0)); },
        [&](double u) { return at(u, statics::state::height); },
        [&](double u) { return at(u, statics::state::concentration); });
    const MembraneSamples samples = sample(space, state);
    const BendingModel model(parameters.membrane);
    const EnergyDerivatives energy = energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first);
    const BoxFlow box(parameters, space);
    const FlowSolution flow = box.solve(box.operators(state, samples), samples, energy,
                                        energy_density_at_rim(space, state, membrane_energy(parameters)),
                                        external_load(space, samples, loads_of(parameters)));
    double tension = 0, largest = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const double u = crowded_at(edge, space.xi[i]);
        const double label = solution.globals(statics::global::area) * u * u;
        const auto point = statics::point_of_shape(parameters, label, statics::evaluate(solution, rule, u * u));
        tension = std::max(tension, std::abs(space.tension_rows[i].evaluate(flow.multipliers.tension) - point.tension));
        largest = std::max(largest, std::abs(point.tension));
    }
    const double exact_energy = measure(statics::sampled_curve(parameters, solution, rule, 1001), model).bending_energy;
    return {largest_speed(space, flow.velocity), std::abs(flow.inflow), tension / largest,
            std::abs(2 * pi * energy.energy / exact_energy - 1)};
}
}  // namespace

TEST_CASE("stationary vesicles rest in the engine, too", "[verification]") {
    const auto [family, reduced_volume] =
        GENERATE(std::pair(statics::VesicleFamily::prolate, 0.8), std::pair(statics::VesicleFamily::oblate, 0.7));
    const statics::VesicleState exact = vesicle(reduced_volume, family);
    const VesicleErrors coarse = errors_of(exact, 24), fine = errors_of(exact, 64);
    const auto order = [](double first, double second) { return std::log(first / second) / std::log(64.0 / 24); };
    CAPTURE(reduced_volume, coarse.speed, fine.speed, coarse.tension, fine.tension, coarse.pressure, fine.pressure,
            coarse.energy, fine.energy);
    CHECK(fine.speed < 2e-6);
    CHECK(fine.tension < 1e-7);
    CHECK(fine.pressure < 5e-9);
    CHECK(fine.energy < 2e-10);
    CHECK(order(coarse.speed, fine.speed) > 3);  // driven by a fourth derivative of the shape, and pointwise: 6 - 4 + 1
    CHECK(order(coarse.tension, fine.tension) > 4);
    CHECK(order(coarse.pressure, fine.pressure) > 5);
    CHECK(order(coarse.energy, fine.energy) > 5);
}

TEST_CASE("a stationary bud rests in the engine, too, with and without loads", "[verification]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 22;
    if (GENERATE(false, true)) {
        parameters.membrane.rim_tension = 0.05;
        parameters.fluid.pressure_difference = 1e-4;
        parameters.membrane.pole_force = 5;
    }
    const auto exact = statics::find_stationary_state(parameters);
    const BudErrors coarse = errors_of(exact, 60), fine = errors_of(exact, 120);
    CAPTURE(coarse.speed, fine.speed, coarse.inflow, fine.inflow, coarse.tension, fine.tension, coarse.energy,
            fine.energy);
    CHECK(fine.speed < 2e-3);
    CHECK(fine.inflow < 2e-7);
    CHECK(fine.tension < 2e-4);
    CHECK(fine.energy < 1e-7);
    CHECK(coarse.speed / fine.speed > std::pow(2, 5));  // the coat's edge is just being resolved: more than order 4
    CHECK(coarse.inflow / fine.inflow > std::pow(2, 5));
}
