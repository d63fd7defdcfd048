// Stationary membranes under rim tension, pressure and a pole force: first-order identities, tubes, snap-through.

#include <catch2/catch.hpp>
#include <numbers>

#include "default_rule.h"
#include "shared/parameters/parameter_table.h"
#include "statics/sampled_curve.h"
#include "statics/shape_integrals.h"
#include "statics/stationary_state.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

using std::numbers::pi;

Parameters bare_membrane(double stiffness) {
    Parameters parameters;
    parameters.membrane.curvature_convention = CurvatureConvention::consistent;
    parameters.membrane.bending_stiffness = parameters.membrane.bending_stiffness_coated = stiffness;
    parameters.membrane.spontaneous_curvature = 0;
    parameters.molecules.transport = Transport::advection;
    return parameters;
}

/// `state` solved anew on its own mesh with one of its numbers changed.
ShapeIntegrals at(const StationaryState& state, const std::string& key, double value) {
    const CasePath path = path_in(state.parameters, key);
    const auto problem = stationary_shapes(path, value, 1e-2);
    PiecewiseSolution guess = state.point.solution;
    guess.parameter = value;
    const auto solved = solve_newton(problem, default_rule, guess, parameter_condition(guess, value, problem), 30);
    REQUIRE(solved);
    return shape_integrals(path(value), solved->solution, default_rule);
}

/// df/dx by differences of fourth order.
template <class Function>
double derivative(const Function& f, double x, double step) {
    return (8 * (f(x + step) - f(x - step)) - (f(x + 2 * step) - f(x - 2 * step))) / (12 * step);
}

/// dG/d(key).
double slope_of_potential(const StationaryState& state, const std::string& key, double step) {
    const double here = std::get<double>(find_parameter(key)->get(state.parameters));
    const CasePath path = path_in(state.parameters, key);
    const auto potential = [&](double value) {
        return at(state, key, value).potential(loads_of(path(value).parameters));
    };
    return derivative(potential, here, step);
}

struct Snap {
    std::vector<double> folds;
    BranchEnd end;
};

/// The coat of Hassinger et al., PNAS 2017, whose radius grows to 150 nm or until the neck is 10 nm wide.
Snap growing_coat(double tension, const Resolution& resolution) {
    Parameters parameters = bare_membrane(160);
    parameters.domain.radius = 400;
    parameters.membrane.spontaneous_curvature = 0.04;
    parameters.membrane.rim_tension = tension;
    parameters.molecules.patch_radius = 30;
    const auto before_closing = [](const BranchPoint& point) {
        const auto r2 = point.solution.nodes.row(state::r_squared);
        for (Eigen::Index i = 1; i + 1 < r2.size(); ++i)
            if (r2(i) < 100 && r2(i) < r2(i - 1) && r2(i) < r2(i + 1)) return false;
        return true;
    };
    const auto branch =
        continue_state(find_stationary_state(parameters, resolution), path_in(parameters, "molecules.patch_radius"), 30,
                       150, before_closing, resolution);
    REQUIRE(branch);
    Snap snap{{}, branch->end};
    for (const Fold& fold : branch->folds) snap.folds.push_back(fold.parameter());
    return snap;
}

}  // namespace

TEST_CASE("dG/dσ = A, dG/dp = −V, dG/dF = −z̄", "[statics][loads]") {
    Parameters parameters;
    if (GENERATE(false, true)) {
        parameters.molecules.coupling = Coupling::energetic;
        parameters.molecules.line_energy = 20;
    }
    parameters.molecules.patch_radius = 20;
    // Molecules that diffuse by a law without bending in it do not make G stationary.
    parameters.molecules.transport = Transport::advection;
    parameters.membrane.rim_tension = 0.05;
    parameters.fluid.pressure_difference = 1e-4;
    parameters.membrane.pole_force = 3;
    const auto state = find_stationary_state(parameters);
    const ShapeIntegrals here = shape_integrals(parameters, state.point.solution, default_rule);
    REQUIRE(here.extension > 10);  // a dome
    // The steps make the truncation of the differences about 1e-10, and their round-off.
    const double by_tension = slope_of_potential(state, "membrane.rim_tension", 1e-3);
    const double by_pressure = slope_of_potential(state, "fluid.pressure_difference", 1e-5);
    const double by_force = slope_of_potential(state, "membrane.pole_force", 0.05);
    CHECK(by_force == Approx(-here.extension).epsilon(1e-8));
    CHECK(by_pressure == Approx(-here.volume).epsilon(1e-8));
    CHECK(by_tension == Approx(here.area).epsilon(1e-8));
}

TEST_CASE("dG/dF_a = −(z̄_c − z̄_ring)", "[statics][loads]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 20;
    parameters.molecules.transport = Transport::advection;
    parameters.membrane.rim_tension = 0.05;
    parameters.membrane.coat_force = 5;
    if (GENERATE(false, true)) parameters.membrane.coat_force_ring = {30, 60};
    const auto state = find_stationary_state(parameters);
    const ShapeIntegrals here = shape_integrals(parameters, state.point.solution, default_rule);
    REQUIRE(here.coat_extension > 10);  // a dome
    // As for the other loads. The ring's density has four derivatives, which costs no digit of these.
    CHECK(slope_of_potential(state, "membrane.coat_force", 0.05) == Approx(-here.coat_extension).epsilon(1e-8));
    CHECK(slope_of_potential(state, "membrane.rim_tension", 1e-3) == Approx(here.area).epsilon(1e-8));
}

TEST_CASE("dG/dF_d = r̄", "[statics][loads]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 22;
    parameters.molecules.transport = Transport::advection;
    parameters.membrane.collar_force = 5;
    parameters.membrane.collar_position = 35;
    const auto state = find_stationary_state(parameters);
    const ShapeIntegrals here = shape_integrals(parameters, state.point.solution, default_rule);
    REQUIRE(here.collar_radius < 25);  // on the neck of a dome
    CHECK(slope_of_potential(state, "membrane.collar_force", 0.05) == Approx(here.collar_radius).epsilon(1e-8));
    CHECK(slope_of_potential(state, "membrane.rim_tension", 1e-3) == Approx(here.area).epsilon(1e-8));
}

TEST_CASE("a force on molecules in equilibrium pulls as on those that stay where both are the same",
          "[statics][loads]") {
    // To first order in the force the shape of a flat membrane does not move the molecules: so weak a curvature and
    // force leave c that of the flat membrane, whose profile is its equilibrium but for the rim.
    Parameters parameters;
    parameters.membrane.spontaneous_curvature = 0;
    parameters.membrane.coat_force = 1e-3;
    parameters.membrane.coat_force_ring = {45, 75};
    const auto moving = find_stationary_state(parameters);
    parameters.molecules.transport = Transport::advection;
    const auto staying = find_stationary_state(parameters);
    const double expected = shape_integrals(parameters, staying.point.solution, default_rule).coat_extension;
    parameters.molecules.transport = Transport::cahn_hilliard;
    const double found = shape_integrals(parameters, moving.point.solution, default_rule).coat_extension;
    REQUIRE(expected > 0);
    CHECK(found ==
          Approx(expected).epsilon(0.05));  // Gibbs and Thomson: c of 0.4 % around the coat comes from its edge
}

TEST_CASE("as loads vanish the unloaded shape is left", "[statics][loads]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 22;
    const auto unloaded = find_stationary_state(parameters);
    const ShapeIntegrals none = shape_integrals(parameters, unloaded.point.solution, default_rule);
    parameters.membrane.rim_tension = 1e-14;
    parameters.fluid.pressure_difference = 1e-16;
    parameters.membrane.pole_force = 1e-12;
    parameters.membrane.coat_force = 1e-12;
    parameters.membrane.coat_force_ring = {30, 60};
    const auto loaded = find_stationary_state(parameters);
    const ShapeIntegrals vanishing = shape_integrals(parameters, loaded.point.solution, default_rule);
    // Newton's method leaves some 1e-12, on meshes that the way to the state has made.
    CHECK(vanishing.energy == Approx(none.energy).epsilon(1e-10));
    CHECK(vanishing.area == Approx(none.area).epsilon(1e-10));
    CHECK(vanishing.volume == Approx(none.volume).epsilon(1e-10));
    CHECK(vanishing.extension == Approx(none.extension).epsilon(1e-10));
}

TEST_CASE("where coupled molecules move, dG = A dσ − V dp − z̄ dF − μ c(rim) dA", "[statics][loads]") {
    // The shape and c make G stationary but for the membrane that flows in: none of the molecules that are at the rim
    // come with it, so that each new area takes μ c(rim) out of the coat.
    Parameters parameters;
    parameters.molecules.patch_radius = 20;
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 40;
    parameters.membrane.spontaneous_curvature = 0.03;
    parameters.membrane.rim_tension = 0.05;
    parameters.fluid.pressure_difference = 1e-4;
    parameters.membrane.pole_force = 3;
    const auto state = find_stationary_state(parameters);
    const ShapeIntegrals here = shape_integrals(parameters, state.point.solution, default_rule);
    REQUIRE(here.extension > 5);
    const auto& solution = state.point.solution;
    const auto last = solution.nodes.col(solution.nodes.cols() - 1);
    const double brought = parameters.molecules.line_energy * solution.globals(global::potential) *
                           last(state::concentration);  // μ c(rim), pN/nm
    REQUIRE(std::abs(brought) > 1e-4);                  // of 0.05 pN/nm
    const auto check = [&](const std::string& key, double step, double expected) {
        const double value = std::get<double>(find_parameter(key)->get(parameters));
        const auto area = [&](double of) { return at(state, key, of).area; };
        CHECK(slope_of_potential(state, key, step) + brought * derivative(area, value, step) ==
              Approx(expected).epsilon(1e-8));
    };
    check("membrane.pole_force", 0.05, -here.extension);
    check("fluid.pressure_difference", 1e-5, -here.volume);
    check("membrane.rim_tension", 1e-3, here.area);
}

TEST_CASE("coupled molecules in equilibrium: λ + μ c is the same everywhere", "[statics][loads]") {
    // Along the membrane ∇λ = −(δE/δc) ∇c, and δE/δc = μ.
    Parameters parameters;
    parameters.molecules.patch_radius = 20;
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 40;
    parameters.membrane.spontaneous_curvature = 0.03;
    const auto state = find_stationary_state(parameters);
    const double potential = parameters.molecules.line_energy * state.point.solution.globals(global::potential);
    const MembraneCurve curve = sampled_curve(parameters, state.point.solution, default_rule, 201);
    const double at_rim = curve.lambda.back() + potential * curve.c.back();
    CHECK(std::abs(curve.lambda.back()) < 1e-10);
    double worst = 0;
    for (std::size_t i = 0; i < curve.size(); ++i)
        worst = std::max(worst, std::abs(curve.lambda[i] + potential * curve.c[i] - at_rim));
    CHECK(worst < 1e-8 * std::abs(potential));
}

TEST_CASE("A tube is pulled at F = 2π √(2βσ), after an overshoot that is larger in a small box", "[statics][loads]") {
    // I. Derényi, F. Jülicher & J. Prost, Phys. Rev. Lett. 88, 238101 (2002): +13 % for a wide membrane.
    const double beta = 100, tension = 0.1, plateau = 2 * pi * std::sqrt(2 * beta * tension);
    std::vector<double> overshoot;
    for (const double radius : {80.0, 200.0}) {
        Parameters parameters = bare_membrane(beta);
        parameters.domain.radius = radius;
        parameters.domain.height = 700;
        parameters.membrane.rim_tension = tension;
        double largest = 0, last = 0, deviation = 0;
        std::vector<double> forces;
        const auto visit = [&](const BranchPoint& point) {
            last = point.solution.parameter;
            forces.push_back(last);
            largest = std::max(largest, last);
            if (point.solution.nodes(state::height, 0) - parameters.domain.membrane_height > 300)
                deviation = std::max(deviation, std::abs(last / plateau - 1));
            return !reaches_top_or_bottom(parameters, point.solution);
        };
        const auto branch = continue_state(find_stationary_state(parameters),
                                           path_in(parameters, "membrane.pole_force"), 0, 100, visit);
        REQUIRE(branch);
        REQUIRE(branch->folds.size() >= 3);  // the oscillation is damped in the tube's length
        // A fold for each extremum of the points, down to 3e-8 of the force: tangents are that accurate, and none is
        // lost.
        int extrema = 0;
        for (std::size_t i = 1; i + 1 < forces.size(); ++i)
            if ((forces[i] - forces[i - 1]) * (forces[i + 1] - forces[i]) < 0) ++extrema;
        CHECK(extrema == 6);
        CHECK(static_cast<int>(branch->folds.size()) == extrema);
        CHECK(branch->last.folds_before == extrema);
        CHECK(branch->folds.front().parameter() >= largest);
        CHECK(deviation < 1e-3);                       // of a tube of more than 300 nm
        CHECK(last == Approx(plateau).epsilon(1e-7));  // of 620 nm
        overshoot.push_back(largest / plateau - 1);
    }
    CHECK(overshoot[0] > overshoot[1]);
    CHECK(overshoot[1] == Approx(0.13).margin(0.01));
}

TEST_CASE("A growing coat snaps through two folds at 0.02 pN/nm, and at no other tension", "[statics][loads]") {
    // J. E. Hassinger et al., PNAS 114, E1118 (2017), Fig. 3.
    CHECK(growing_coat(0.002, {}).folds.empty());
    const Snap taut = growing_coat(0.2, {});
    CHECK(taut.folds.empty());
    CHECK(taut.end == BranchEnd::reached_target);
    const Snap coarse = growing_coat(0.02, {}), fine = growing_coat(0.02, {5, 96});
    REQUIRE(coarse.folds.size() == 2);
    REQUIRE(fine.folds.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) CHECK(coarse.folds[i] == Approx(fine.folds[i]).epsilon(1e-6));
    CHECK(fine.folds[0] > fine.folds[1]);  // an S: between the two radii there are three shapes
}
