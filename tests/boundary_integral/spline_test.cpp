// The spline spaces: partition of unity, parity, derivatives, order of approximation; and the quadrature rules.

#include <catch2/catch.hpp>
#include <cmath>

#include "boundary_integral/quadrature/singular_rules.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

double interpolation_error(Index elements, Parity parity, const Profile& f) {
    const SplineSpace space(5, uniform_breakpoints(elements), parity);
    const Eigen::VectorXd coefficients = spline_of(space, f);
    double error = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double xi = i / 1000.0;
        error = std::max(error, std::abs(space.basis(xi).evaluate(coefficients) - f(xi)));
    }
    return error;
}

}  // namespace

TEST_CASE("even splines sum to one and have no slope on the axis", "[splines]") {
    const int degree = GENERATE(4, 5);
    const SplineSpace space(degree, uniform_breakpoints(12), Parity::even);
    CHECK(space.dimension() == 12 + (degree == 5 ? 3 : 2));
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(space.dimension());
    for (const double xi : {0.0, 0.01, 0.2, 0.5, 0.77, 1.0}) {
        CHECK(space.basis(xi).evaluate(ones) == Approx(1).epsilon(1e-14));
        CHECK(space.basis(xi).evaluate(ones, 1) == Approx(0).margin(1e-11));
    }
    for (Index j = 0; j < space.dimension(); ++j) {
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(space.dimension(), j);
        CHECK(space.basis(0.0).evaluate(unit, 1) == Approx(0).margin(1e-11));
    }
}

TEST_CASE("odd splines vanish on the axis with their curvature", "[splines]") {
    const SplineSpace space(5, uniform_breakpoints(12), Parity::odd);
    CHECK(space.dimension() == 12 + 2);
    for (Index j = 0; j < space.dimension(); ++j) {
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(space.dimension(), j);
        CHECK(space.basis(0.0).evaluate(unit) == Approx(0).margin(1e-14));
        CHECK(space.basis(0.0).evaluate(unit, 2) == Approx(0).margin(1e-9));
    }
}

TEST_CASE("the Taylor polynomial reproduces the spline inside its element", "[splines]") {
    const SplineSpace space(5, uniform_breakpoints(10), Parity::odd);
    const Eigen::VectorXd coefficients = spline_of(space, [](double x) { return std::sin(3 * x); });
    const auto taylor = space.taylor(coefficients, 0.3, 3);
    double value = 0, factor = 1;
    for (std::size_t k = 0; k < 6; ++k) {
        value += taylor[k] * factor;
        factor *= 0.08 / static_cast<double>(k + 1);
    }
    CHECK(value == Approx(space.basis(0.38).evaluate(coefficients)).epsilon(1e-13));
}

TEST_CASE("quintic interpolation converges with order six", "[splines]") {
    const auto even = [](double x) { return std::cos(5 * x); };
    const auto odd = [](double x) { return std::sin(5 * x); };
    // Doubling the elements must gain close to 2^6 = 64.
    CHECK(interpolation_error(16, Parity::even, even) / interpolation_error(32, Parity::even, even) > 45);
    CHECK(interpolation_error(16, Parity::odd, odd) / interpolation_error(32, Parity::odd, odd) > 45);
}

TEST_CASE("singular rules integrate what they are made for", "[quadrature]") {
    const QuadratureRule base = gauss_legendre(24);
    const OffsetRule logarithmic = logarithmic_rule(0, 1, 0.3, base);
    double sum = 0;
    for (std::size_t i = 0; i < logarithmic.offsets.size(); ++i) {
        sum += logarithmic.weights[i] * std::log(std::abs(logarithmic.offsets[i]));
    }
    // int_0^1 ln|x - 0.3| dx; the rule's error for the bare logarithm decays like n^-6.
    CHECK(sum == Approx(0.3 * std::log(0.3) + 0.7 * std::log(0.7) - 1).epsilon(2e-8));

    const double width = GENERATE(1e-1, 1e-3, 1e-5);
    const OffsetRule near = near_singular_rule(0, 1, 0.3, width, base);
    double poisson = 0;
    for (std::size_t i = 0; i < near.offsets.size(); ++i) {
        poisson += near.weights[i] * width / (near.offsets[i] * near.offsets[i] + width * width);
    }
    CHECK(poisson == Approx(std::atan(0.7 / width) + std::atan(0.3 / width)).epsilon(1e-8));
}
