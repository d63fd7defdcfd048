// Stationary membranes: against numbers from elsewhere, order of convergence, folds, limits.

#include <catch2/catch.hpp>
#include <fstream>
#include <numbers>
#include <sstream>

#include "default_rule.h"
#include "shared/geometry/observables.h"
#include "statics/sampled_curve.h"
#include "statics/stationary_state.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

Parameters patch(double radius, Transport transport) {
    Parameters parameters;
    parameters.molecules.patch_radius = radius;
    parameters.molecules.transport = transport;
    return parameters;
}

MembraneCurve curve_of(const StationaryState& state) {
    return sampled_curve(state.parameters, state.point.solution, default_rule, 1001);
}

/// Rows of a CSV file after comments and the header.
std::vector<std::vector<double>> numbers_of(const std::string& file) {
    std::ifstream stream(file);
    REQUIRE(stream);
    std::vector<std::vector<double>> rows;
    std::string line;
    while (std::getline(stream, line)) {
        if (line.empty() || line[0] == '#' || line[0] == 'p') continue;
        std::istringstream cells(line);
        std::string cell;
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

/// Area, apex height and apex moment on the state's mesh cut in two `halvings` times, with k points per element.
Eigen::Vector3d figures(const StationaryState& state, const std::vector<double>& coarse, int halvings, int k) {
    const Parameters& parameters = state.parameters;
    const double curvature = parameters.membrane.spontaneous_curvature;
    const auto problem = stationary_shapes(
        [&](double value) {
            Parameters changed = parameters;
            changed.membrane.spontaneous_curvature = value;
            return changed;
        },
        curvature, curvature);
    std::vector<double> mesh = coarse;
    for (int i = 0; i < halvings; ++i) mesh = halved_mesh(mesh);
    const GaussRule rule(k);
    const auto accurate = [&](double x) { return evaluate(state.point.solution, default_rule, x); };
    const auto slope = [&](double x) -> Eigen::VectorXd { return (accurate(x + 1e-6) - accurate(x - 1e-6)) / 2e-6; };
    const auto guess = sample(mesh, rule, accurate, slope, state.point.solution.globals, curvature);
    const auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, curvature, problem), 30);
    REQUIRE(solved);
    const auto& s = solved->solution;
    return {s.globals(global::area) / 3200, s.nodes(state::height, 0) / 80, s.nodes(state::moment, 0)};
}

/// A term that statics does not know: ½ γ κ².
struct ToyTerm {
    double stiffness;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        return 0.5 * stiffness * x.curvature * x.curvature;
    }
};

}  // namespace

TEST_CASE("The reference shapes: Cahn-Hilliard equilibrium with the mass of a disc", "[statics]") {
    // Columns: patch radius, neck radius, bud diameter, membrane area, curve length, apex height; 7 digits.
    const auto rows = numbers_of(ENDOFLOW_REFERENCE_DIR "/statics.csv");
    REQUIRE(rows.size() == 2);
    for (const auto& row : rows) {
        const auto state = find_stationary_state(with_disc_mass(patch(row[0], Transport::cahn_hilliard)));
        const MembraneCurve curve = curve_of(state);
        const Observables seen = measure(curve, BendingModel(state.parameters.membrane));
        CAPTURE(row[0]);
        CHECK(state.relative_error < 1e-9);
        REQUIRE(seen.neck);
        CHECK(seen.neck->radius == Approx(row[1]).epsilon(1e-6));
        CHECK(seen.neck->lateral_diameter == Approx(row[2]).epsilon(1e-6));
        CHECK(seen.membrane_area == Approx(row[3]).epsilon(1e-6));
        CHECK(curve.s.back() == Approx(row[4]).epsilon(1e-6));
        CHECK(curve.z.front() - curve.z.back() == Approx(row[5]).epsilon(1e-6));
        CHECK(seen.molecule_mass == Approx(std::numbers::pi * row[0] * row[0]).epsilon(1e-7));
    }
}

TEST_CASE("The sampled curve has the solution's area and arc length", "[statics]") {
    const auto state = find_stationary_state(patch(22, Transport::advection));
    const MembraneCurve curve = curve_of(state);
    const Observables seen = measure(curve, BendingModel(state.parameters.membrane));
    CHECK(seen.membrane_area ==
          Approx(2 * std::numbers::pi * state.point.solution.globals(global::area)).epsilon(1e-9));
    CHECK(curve.lambda.back() == Approx(0).margin(1e-10));
    CHECK(curve.r.back() == Approx(80).epsilon(1e-10));
    CHECK(curve.z.back() == Approx(80).epsilon(1e-10));
    // ∫ c dA of the material does not change when the membrane bends.
    const double excess = std::numbers::pi * std::numbers::pi * 1.2 * 1.2 / 6;
    CHECK(seen.molecule_mass == Approx(std::numbers::pi * (22 * 22 + excess)).epsilon(1e-7));
}

TEST_CASE("The order of convergence", "[statics]") {
    const auto state = find_stationary_state(patch(22, Transport::advection));
    const auto coarse =
        equidistributed_mesh(state.point.solution, default_rule,
                             stationary_shapes([&](double) { return state.parameters; }, 0, 1).state_scales, 16);
    const int k = GENERATE(2, 3);
    const Eigen::Vector3d exact = figures(state, coarse, 4, 5);
    std::vector<double> errors;
    for (const int halvings : {1, 2, 3})
        errors.push_back((figures(state, coarse, halvings, k) - exact).cwiseAbs().maxCoeff());
    CAPTURE(k, errors);
    const double order = std::log2(errors[1] / errors[2]);
    CHECK(order > 2 * k - 0.5);
}

TEST_CASE("The fold in patch radius: no state with a neck beyond 25.6 nm", "[statics]") {
    const auto state = find_stationary_state(patch(24, Transport::cahn_hilliard));
    const CasePath path = [&](double radius) { return patch(radius, Transport::cahn_hilliard); };
    const Visitor until_fold = [](const BranchPoint& point) { return point.folds_before == 0; };
    const auto branch = continue_state(state, path, 24, 30, until_fold);
    REQUIRE(branch);
    REQUIRE(branch->folds.size() == 1);
    CHECK(branch->folds[0].parameter() == Approx(25.6).epsilon(2e-3));       // two digits are known elsewhere
    CHECK(branch->folds[0].parameter() == Approx(25.594251).epsilon(1e-6));  // what this solver gives
    const auto other = continue_state(state, path, 24, 30, until_fold, Resolution{6, 36});
    REQUIRE(other);
    REQUIRE(other->folds.size() == 1);
    CHECK(branch->folds[0].parameter() == Approx(other->folds[0].parameter()).epsilon(1e-8));
    CHECK(state.point.folds_before == 0);
}

TEST_CASE("Folds in spontaneous curvature and in patch radius are the same states", "[statics]") {
    // A fold is where the linearised equations without the parameter are singular, whatever the parameter is.
    const auto fold = [](const Parameters& from, const CasePath& path, double begin, double end) {
        const auto branch = continue_state(find_stationary_state(from), path, begin, end,
                                           [](const BranchPoint& point) { return point.folds_before == 0; });
        REQUIRE(branch);
        REQUIRE(branch->folds.size() == 1);
        return branch->folds[0].parameter();
    };
    const auto with = [](double radius, double curvature) {
        Parameters parameters = patch(radius, Transport::cahn_hilliard);
        parameters.membrane.spontaneous_curvature = curvature;
        return parameters;
    };
    const double curvature = fold(
        with(22, 0.06), [&](double value) { return with(22, value); }, 0.06, 0.12);
    const double radius = fold(
        with(20, curvature), [&](double value) { return with(value, curvature); }, 20, 26);
    CAPTURE(curvature, radius);
    CHECK(radius == Approx(22).epsilon(1e-7));
}

TEST_CASE("A case beyond the fold is refused with the fold's place", "[statics]") {
    try {
        (void)find_stationary_state(patch(26.5, Transport::cahn_hilliard), Resolution{4, 24});
        FAIL("there is no such state");
    } catch (const SolverError& error) {
        CHECK(error.name() == "no-stationary-state");
        CHECK(std::string(error.what()).find("molecules.patch_radius = 25.594") != std::string::npos);
    }
}

TEST_CASE("Frozen molecules: the neck closes near 29 nm without a fold", "[statics]") {
    const auto state = find_stationary_state(patch(26, Transport::advection));
    const auto branch = continue_state(
        state, [&](double radius) { return patch(radius, Transport::advection); }, 26, 32,
        [](const BranchPoint&) { return true; });
    REQUIRE(branch);
    CHECK(branch->folds.empty());
    CHECK(neck_closes(*branch));
    CHECK(branch->last.solution.parameter == Approx(29).margin(0.2));
}

TEST_CASE("Without spontaneous curvature the membrane is flat", "[statics]") {
    const auto transport = GENERATE(Transport::advection, Transport::cahn_hilliard, Transport::fickian);
    Parameters parameters = patch(30, transport);
    parameters.membrane.spontaneous_curvature = 0;
    const MembraneCurve curve = curve_of(find_stationary_state(parameters));
    for (std::size_t i = 0; i < curve.size(); ++i) {
        REQUIRE(curve.z[i] == Approx(80).epsilon(1e-11));
        REQUIRE(std::abs(curve.kappa[i]) < 1e-12);
        REQUIRE(curve.r[i] == Approx(curve.s[i]).margin(1e-8));
    }
}

TEST_CASE("Fickian molecules spread evenly and leave the membrane flat", "[statics]") {
    const auto state = find_stationary_state(patch(30, Transport::fickian));
    const MembraneCurve curve = curve_of(state);
    CHECK(curve.c.front() == Approx(curve.c.back()).epsilon(1e-9));
    CHECK(curve.c.front() == Approx((900 + std::numbers::pi * std::numbers::pi * 0.24) / 6400).epsilon(1e-6));
    CHECK(std::abs(curve.z.front() - 80) < 1e-9);
}

TEST_CASE("Reversed spontaneous curvature mirrors the shape", "[statics]") {
    Parameters parameters = patch(20, Transport::advection);
    const auto up = find_stationary_state(parameters);
    parameters.membrane.spontaneous_curvature *= -1;
    const auto down = find_stationary_state(parameters);
    const auto height = [](const StationaryState& s) { return s.point.solution.nodes(state::height, 0) - 80; };
    CHECK(height(up) > 20);
    CHECK(height(down) == Approx(-height(up)).epsilon(1e-10));
}

TEST_CASE("Every constitutive law and convention has a stationary shape for a small patch", "[statics]") {
    Parameters parameters = patch(16, Transport::advection);
    parameters.membrane.constitutive_law =
        GENERATE(ConstitutiveLaw::linear, ConstitutiveLaw::coarse_grained, ConstitutiveLaw::lumped);
    parameters.membrane.curvature_convention =
        GENERATE(CurvatureConvention::as_printed, CurvatureConvention::consistent);
    const auto state = find_stationary_state(parameters);
    CHECK(state.relative_error < 1e-9);
    CHECK(state.point.solution.nodes(state::height, 0) > 85);
}

TEST_CASE("A term added to the energy changes the stationary shape as it must", "[statics]") {
    // With uniform stiffness, ½ β (κ − C)² + ½ γ κ² = ½ (β + γ) (κ − β C/(β + γ))² + a function of c alone, which does
    // nothing to a shape whose molecules stay in the material.
    Parameters bare = patch(30, Transport::advection);
    bare.membrane.bending_stiffness_coated = bare.membrane.bending_stiffness = 200;  // β = 100 pN nm
    bare.membrane.spontaneous_curvature = 0.03;
    constexpr double added = 50;
    Parameters equivalent = bare;
    equivalent.membrane.bending_stiffness_coated = equivalent.membrane.bending_stiffness = 300;
    equivalent.membrane.spontaneous_curvature = 0.02;
    const auto exact = find_stationary_state(equivalent);

    const CasePath with_toy = [&](double stiffness) {
        return StationaryCase(bare, membrane_energy(bare).add(ToyTerm{stiffness}));
    };
    const auto visit = [](const BranchPoint&) { return true; };
    const auto branch = continue_state(find_stationary_state(bare), with_toy, 0, added, visit);
    REQUIRE(branch);
    REQUIRE(branch->end == BranchEnd::reached_target);
    const auto at_apex = [](const PiecewiseSolution& solution) {
        return Eigen::Vector3d(solution.nodes(state::height, 0), solution.nodes(state::moment, 0),
                               solution.globals(global::area));
    };
    const Eigen::Vector3d wanted = at_apex(exact.point.solution), found = at_apex(branch->last.solution);
    REQUIRE(wanted(0) > 85);                                                         // a dome, not a flat membrane
    for (int i = 0; i < 3; ++i) CHECK(found(i) == Approx(wanted(i)).epsilon(1e-8));  // of two meshes
}
