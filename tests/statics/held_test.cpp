// Membranes whose neck is held: the force is dG/dR, without force they are the free ones, and what has no neck is
// named.

#include <catch2/catch.hpp>

#include "default_rule.h"
#include "statics/neck_work.h"
#include "statics/shape_integrals.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

Parameters coat(double radius, Transport transport) {
    Parameters parameters;
    parameters.molecules.patch_radius = radius;
    parameters.molecules.transport = transport;
    return parameters;
}

ShapeIntegrals integrals_of(const HeldState& state) {
    return shape_integrals(state.held.stationary, joined(state.point.solution, default_rule), default_rule);
}

double potential_of(const HeldState& state) {
    return integrals_of(state).potential(loads_of(state.held.stationary.parameters));
}

/// `state` solved anew on its own mesh with another radius.
HeldState at(const HeldState& state, double radius) {
    const auto problem = held_shapes([&](double value) { return HeldCase{state.held.stationary, value}; }, radius, 1);
    PiecewiseSolution guess = state.point.solution;
    guess.parameter = radius;
    auto solved = solve_newton(problem, default_rule, guess, parameter_condition(guess, radius, problem), 30);
    REQUIRE(solved);
    return {{state.held.stationary, radius}, {solved->solution, solved->tangent, 0, 0}};
}

/// df/dR at the state's radius by differences of fourth order.
template <class Function>
double by_radius(const HeldState& state, const Function& f) {
    const double x = state.held.radius, step = 0.03;  // truncation about 1e-10 of f, round-off of 𝒢 1e-9 pN
    const auto value = [&](double radius) { return f(at(state, radius)); };
    return (8 * (value(x + step) - value(x - step)) - (value(x + 2 * step) - value(x - 2 * step))) / (12 * step);
}

/// The error's name, empty when there is none.
template <class Function>
std::string error_of(const Function& f) {
    try {
        f();
    } catch (const SolverError& error) {
        return error.name();
    }
    return "";
}

}  // namespace

TEST_CASE("f = dG/dR, under loads and with line energy", "[statics][held]") {
    Parameters parameters = coat(22, Transport::advection);
    parameters.membrane.rim_tension = 0.05;
    parameters.fluid.pressure_difference = 1e-4;
    parameters.membrane.pole_force = 3;
    if (GENERATE(false, true)) {
        parameters.molecules.coupling = Coupling::energetic;
        parameters.molecules.line_energy = 20;
    }
    const HeldState found = find_held_neck(parameters);
    for (const double radius : {10.0, 6.0}) {
        const HeldState state = held_at(found, radius);
        CAPTURE(radius, state.force());
        REQUIRE(std::abs(state.force()) > 10);  // pN
        CHECK(by_radius(state, potential_of) == Approx(state.force()).epsilon(1e-8));
    }
}

TEST_CASE("where coupled molecules move, f = dG/dR + μ c(rim) dA/dR", "[statics][held]") {
    // As along branches in loads: new area takes μ c(rim) out of the coat.
    Parameters parameters = coat(22, Transport::cahn_hilliard);
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 40;
    const HeldState state = held_at(find_held_neck(parameters), 9);
    const PiecewiseSolution whole = joined(state.point.solution, default_rule);
    const double brought = parameters.molecules.line_energy * whole.globals(global::potential) *
                           whole.nodes(state::concentration, whole.nodes.cols() - 1);
    REQUIRE(std::abs(state.force()) > 1);
    const auto area = [](const HeldState& of) { return integrals_of(of).area; };
    CHECK(by_radius(state, potential_of) + brought * by_radius(state, area) == Approx(state.force()).epsilon(1e-8));
}

TEST_CASE("a free shape's neck is held by no force", "[statics][held]") {
    const Parameters parameters = coat(22, GENERATE(Transport::advection, Transport::cahn_hilliard));
    const StationaryState free = find_stationary_state(parameters);
    const PiecewiseSolution& solution = free.point.solution;
    const auto neck = place_of_neck(solution, default_rule);
    REQUIRE(neck);
    const double radius = std::sqrt(evaluate(solution, default_rule, *neck)(state::r_squared));
    const HeldState state = held_at(find_held_neck(parameters), radius);
    const ShapeIntegrals held = integrals_of(state), own = shape_integrals(parameters, solution, default_rule);
    // Meshes differ; the place of the neck is interpolated, of sixth order, which the force's slope multiplies.
    CHECK(std::abs(state.force()) < 1e-6);  // of some 50 pN at other radii
    CHECK(held.energy == Approx(own.energy).epsilon(1e-8));
    CHECK(held.area == Approx(own.area).epsilon(1e-9));
    CHECK(state.point.solution.globals(held_global::neck) ==
          Approx(*neck * solution.globals(global::area)).epsilon(1e-6));
}

TEST_CASE("a held neck, mirrored and on a finer mesh", "[statics][held]") {
    Parameters parameters = coat(30, Transport::advection);
    parameters.membrane.rim_tension = 0.02;
    const HeldState state = held_at(find_held_neck(parameters), 5);
    const auto fine = refined_held(state);
    REQUIRE(fine);
    CHECK(fine->force() == Approx(state.force()).epsilon(1e-8));
    CHECK(potential_of(*fine) == Approx(potential_of(state)).epsilon(1e-9));
    parameters.membrane.spontaneous_curvature *= -1;
    const HeldState mirrored = held_at(find_held_neck(parameters), 5);
    CHECK(mirrored.force() == Approx(state.force()).epsilon(1e-8));  // meshes of two ways to the state
    CHECK(potential_of(mirrored) == Approx(potential_of(state)).epsilon(1e-9));
}

TEST_CASE("the work along a branch is the rise of G, and begins at the free neck", "[statics][held]") {
    const HeldState widest = widest_held(find_held_neck(coat(22, Transport::advection)));
    CHECK(widest.held.radius > 14.9);
    const double begin = potential_of(widest);
    NeckWork work(3);
    double worst = 0;
    const auto visit = [&](const HeldState& state) {
        worst = std::max(worst, std::abs(work.to(state) - (potential_of(state) - begin)));
        return true;
    };
    const HeldBranch branch = follow_radius(widest, 3, visit);
    REQUIRE(branch.branch.end == BranchEnd::reached_target);
    CHECK(worst < 1e-4);  // pN nm: fourth order in the steps; 1e-5 was found
    CHECK(work.barrier().from_radius == Approx(13.6998665).epsilon(1e-6));  // the free shape's neck, docs/statics.md
    CHECK(work.barrier().to_radius == 3);
    const double least =
        shape_integrals(widest.held.stationary, find_stationary_state(widest.held.stationary.parameters).point.solution,
                        default_rule)
            .energy;
    CHECK(work.barrier().height ==
          Approx(potential_of({{widest.held.stationary, 3}, branch.branch.last}) - least).margin(1e-4));
    CHECK(work.strongest_constriction() > 90);
}

TEST_CASE("what has no neck to hold is named", "[statics][held]") {
    const HeldState state = find_held_neck(coat(22, Transport::advection));
    CHECK(error_of([&] { (void)held_at(state, 20); }) == "held-neck-opens");
    Parameters bare = coat(22, Transport::advection);
    bare.membrane.bending_stiffness_coated = bare.membrane.bending_stiffness;
    bare.membrane.spontaneous_curvature = 0.001;
    CHECK(error_of([&] { (void)find_held_neck(bare); }) == "no-held-neck");
    // One of which another place is narrower.
    const PiecewiseSolution whole = joined(state.point.solution, default_rule);
    PiecewiseSolution pinched = state.point.solution;
    pinched.nodes(state::r_squared, pinched.nodes.cols() / 2) = 1;
    CHECK(fault_of(state.held, pinched, default_rule) == HeldFault::narrower);
    CHECK_FALSE(fault_of(state.held, state.point.solution, default_rule));
    CHECK(place_of_neck(whole, default_rule).value() ==
          Approx(state.point.solution.globals(held_global::neck) / whole.globals(global::area)).epsilon(1e-9));
}
