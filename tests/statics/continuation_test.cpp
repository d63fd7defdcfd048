// Pseudo-arclength continuation on a problem whose fold is known.

#include <catch2/catch.hpp>

#include "bratu.h"
#include "statics/continuation.h"

using namespace endoflow::statics;

namespace {

PiecewiseSolution flat_solution(const GaussRule& rule) {
    const auto zero = [](double) -> Eigen::VectorXd { return Eigen::Vector2d::Zero(); };
    std::vector<double> mesh;
    for (int i = 0; i <= 20; ++i) mesh.push_back(i / 20.0);
    return sample(mesh, rule, zero, zero, Eigen::VectorXd(0), 0);
}

const auto anything = [](const PiecewiseSolution&) { return true; };
const auto everywhere = [](const BranchPoint&) { return true; };

}  // namespace

TEST_CASE("A branch is followed around a fold and the fold is located", "[statics]") {
    const GaussRule rule(4);
    const auto problem = bratu_problem();
    const auto start = begin_branch(problem, rule, flat_solution(rule), 5);
    REQUIRE(start);
    double highest = 0;
    const Visitor visit = [&](const BranchPoint& point) {
        highest = std::max(highest, point.solution.parameter);
        return point.solution.parameter > 1 || point.folds_before == 0;
    };
    const Branch branch = follow_branch(problem, rule, *start, 5, {}, anything, visit);
    CHECK(branch.end == BranchEnd::stopped);
    REQUIRE(branch.folds.size() == 1);
    CHECK(branch.folds[0].parameter() == Approx(3.513830719125162).epsilon(1e-9));
    CHECK(highest <= branch.folds[0].parameter() * (1 + 1e-12));
    CHECK(branch.last.folds_before == 1);
    CHECK(branch.last.tangent.parameter < 0);
}

TEST_CASE("A tangent is that of the solution, wherever Newton's method came from", "[statics]") {
    // Its part of the parameter, whose sign tells folds, may be far smaller than Newton's last change.
    const GaussRule rule(4);
    const auto problem = bratu_problem();
    const auto solved = [&](const PiecewiseSolution& guess) {
        return solve_newton(problem, rule, guess, parameter_condition(guess, 1, problem), 20);
    };
    const auto from_afar = solved(flat_solution(rule));
    REQUIRE(from_afar);
    const auto from_here = solved(from_afar->solution);
    REQUIRE(from_here);
    PiecewiseSolution difference = from_afar->tangent;
    difference.add(-1, from_here->tangent);
    CHECK(largest_entry(difference, problem) < 1e-12);
}

TEST_CASE("A branch ends exactly at its target", "[statics]") {
    const GaussRule rule(4);
    const auto problem = bratu_problem();
    const auto start = begin_branch(problem, rule, flat_solution(rule), 3.5);
    REQUIRE(start);
    const Branch branch = follow_branch(problem, rule, *start, 3.5, {}, anything, everywhere);
    CHECK(branch.end == BranchEnd::reached_target);
    CHECK(branch.last.solution.parameter == Approx(3.5).epsilon(1e-14));
    CHECK(branch.folds.empty());
    CHECK(evaluate(branch.last.solution, rule, 0.5)(0) == Approx(bratu_maximum(3.5)).epsilon(1e-9));
}

TEST_CASE("Inadmissible points end a branch", "[statics]") {
    const GaussRule rule(4);
    const auto problem = bratu_problem();
    const auto start = begin_branch(problem, rule, flat_solution(rule), 3);
    REQUIRE(start);
    const auto low = [](const PiecewiseSolution& solution) { return solution.nodes.row(0).maxCoeff() < 0.2; };
    const Branch branch = follow_branch(problem, rule, *start, 3, {}, low, everywhere);
    CHECK(branch.end == BranchEnd::no_progress);
    CHECK(branch.last.solution.nodes.row(0).maxCoeff() == Approx(0.2).epsilon(1e-3));
}
