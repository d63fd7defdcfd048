// Collocation and Newton's method on a problem whose solution is known.

#include <catch2/catch.hpp>

#include "bratu.h"
#include "statics/newton.h"

using namespace endoflow::statics;

namespace {

std::vector<double> uniform_mesh(std::size_t elements) {
    std::vector<double> mesh;
    for (std::size_t i = 0; i <= elements; ++i) mesh.push_back(static_cast<double>(i) / static_cast<double>(elements));
    return mesh;
}

PiecewiseSolution zero_guess(std::size_t elements, const GaussRule& rule, double parameter) {
    const auto zero = [](double) -> Eigen::VectorXd { return Eigen::Vector2d::Zero(); };
    return sample(uniform_mesh(elements), rule, zero, zero, Eigen::VectorXd(0), parameter);
}

}  // namespace

TEST_CASE("Gauss rules integrate polynomials exactly", "[statics]") {
    for (int k = 1; k <= 8; ++k) {
        const GaussRule rule(k);
        for (int degree = 0; degree < 2 * k; ++degree)
            CHECK(rule.nodes.array().pow(degree).matrix().dot(rule.weights) ==
                  Approx(1.0 / (degree + 1)).margin(1e-12));
        for (int degree = 0; degree < k; ++degree) {
            const Eigen::VectorXd powers = rule.nodes.array().pow(degree);
            CHECK(rule.integrals(0.3).dot(powers) == Approx(std::pow(0.3, degree + 1) / (degree + 1)).margin(1e-11));
            CHECK(rule.values(0.3).dot(powers) == Approx(std::pow(0.3, degree)).margin(1e-11));
        }
    }
}

TEST_CASE("Collocation at k Gauss points has order 2k at the mesh points and k + 1 between them", "[statics]") {
    const int k = GENERATE(2, 3);
    const GaussRule rule(k);
    const auto problem = bratu_problem();
    const double p = 2, exact = bratu_maximum(p);
    const double theta = 4 * std::acosh(std::exp(exact / 2));
    const auto solution = [&](double x) { return exact - 2 * std::log(std::cosh((x - 0.5) * theta / 2)); };
    std::vector<double> at_node, between;
    for (const std::size_t elements : {4U, 8U, 16U}) {
        const auto guess = zero_guess(elements, rule, p);
        const auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, p, problem), 30);
        REQUIRE(solved);
        at_node.push_back(std::abs(evaluate(solved->solution, rule, 0.5)(0) - exact));
        between.push_back(0);
        for (double x = 0; x < 1; x += 1.0 / 512)
            between.back() = std::max(between.back(), std::abs(evaluate(solved->solution, rule, x)(0) - solution(x)));
    }
    const double order = std::log2(at_node[0] / at_node[2]) / 2, order_between = std::log2(between[0] / between[2]) / 2;
    CAPTURE(k, at_node, between);
    CHECK(order == Approx(2 * k).margin(0.3));
    CHECK(order_between == Approx(k + 1).margin(0.3));
}

TEST_CASE("Damping lets Newton's method converge from far away", "[statics]") {
    const GaussRule rule(3);
    const auto problem = bratu_problem();
    const auto far = [](double x) -> Eigen::VectorXd { return Eigen::Vector2d(20 * x * (1 - x), 20 * (1 - 2 * x)); };
    const auto slope = [](double x) -> Eigen::VectorXd { return Eigen::Vector2d(20 * (1 - 2 * x), -40); };
    const auto guess = sample(uniform_mesh(16), rule, far, slope, Eigen::VectorXd(0), 1);
    const auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, 1, problem), 50);
    REQUIRE(solved);
    CHECK(solved->last_change < 1e-5);
    // The second solution at p = 1, beyond the fold: θ is the larger root, y(1/2) = 4.0915…
    CHECK((evaluate(solved->solution, rule, 0.5)(0) == Approx(4.09146724).epsilon(1e-6) ||
           evaluate(solved->solution, rule, 0.5)(0) == Approx(bratu_maximum(1)).epsilon(1e-6)));
}

TEST_CASE("Newton's method says when there is no solution", "[statics]") {
    const GaussRule rule(3);
    const auto problem = bratu_problem();
    const auto guess = zero_guess(8, rule, 4);  // the fold is at 3.51
    CHECK_FALSE(solve_newton(problem, rule, guess, parameter_condition(guess, 4, problem), 50));
}

TEST_CASE("A guess of another collocation rule is refused", "[statics]") {
    const auto problem = bratu_problem();
    const auto guess = zero_guess(4, GaussRule(3), 1);
    CHECK_THROWS_AS(solve_newton(problem, GaussRule(4), guess, parameter_condition(guess, 1, problem), 5),
                    std::invalid_argument);
}

TEST_CASE("An equidistributed mesh gathers where the solution is steep", "[statics]") {
    const GaussRule rule(4);
    const auto step = [](double x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, std::tanh((x - 0.7) / 0.02));
    };
    const auto slope = [](double x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, std::pow(std::cosh((x - 0.7) / 0.02), -2) / 0.02);
    };
    auto function = sample(uniform_mesh(40), rule, step, slope, Eigen::VectorXd(0), 0);
    for (int i = 0; i < 4; ++i)
        function = sample(equidistributed_mesh(function, rule, Eigen::VectorXd::Ones(1), 40), rule, step, slope,
                          Eigen::VectorXd(0), 0);
    double worst = 0, worst_uniform = 0;
    const auto uniform = sample(uniform_mesh(40), rule, step, slope, Eigen::VectorXd(0), 0);
    for (double x = 0.0005; x < 1; x += 0.001) {
        worst = std::max(worst, (evaluate(function, rule, x) - step(x)).norm());
        worst_uniform = std::max(worst_uniform, (evaluate(uniform, rule, x) - step(x)).norm());
    }
    CHECK(worst < 1e-4);
    CHECK(worst < worst_uniform / 30);
    const auto& mesh = function.mesh;
    CHECK(std::is_sorted(mesh.begin(), mesh.end()));
    CHECK(halved_mesh(mesh).size() == 2 * mesh.size() - 1);
}
