// Stiff linear systems with a matrix that changes in time.

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "boundary_integral/modes/linear_propagation.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;

// Y = R(t) diag(e^{a t}, e^{b t}) with a rotation by the angle sin 2t: L = R D R^T + dR/dt R^T.
struct Rotating {
    double a, b;
    static Eigen::Matrix2d rotation(double t) {
        const double angle = std::sin(2 * t);
        return Eigen::Rotation2Dd(angle).toRotationMatrix();
    }
    [[nodiscard]] std::vector<LinearRate> operator()(double t) const {
        Eigen::Matrix2d spin;
        spin << 0, -1, 1, 0;
        const Eigen::Matrix2d r = rotation(t);
        const Eigen::Matrix2d rate =
            r * Eigen::Vector2d(a, b).asDiagonal() * r.transpose() + 2 * std::cos(2 * t) * spin;
        return {{rate, Eigen::Matrix2d::Identity()}};
    }
    [[nodiscard]] Eigen::Matrix2d exact(double t) const {
        return rotation(t) * Eigen::Vector2d(std::exp(a * t), std::exp(b * t)).asDiagonal();
    }
};

struct Result {
    double error;
    long steps;
};

Result follow(const Rotating& system, double tolerance) {
    LinearPropagation propagation(system, 0.0, {Eigen::Matrix2d::Identity()}, 1e-3, tolerance);
    propagation.advance(0.7);  // not the end: the step that is cut there must not disturb
    propagation.advance(2.0);
    return {(propagation.values()[0] - system.exact(2.0)).norm() / system.exact(2.0).norm(), propagation.steps()};
}

}  // namespace

TEST_CASE("a linear system that turns is followed with order 5", "[modes]") {
    const Rotating system{0.4, -1.5};
    const Result coarse = follow(system, 1e-4), fine = follow(system, 1e-8);
    CAPTURE(coarse.error, coarse.steps, fine.error, fine.steps);
    CHECK(coarse.error < 1e-4);
    CHECK(fine.error < 1e-8);
    // The estimate is of order 4 a step: ten times as many steps, an error of 10^-5 then.
    CHECK(fine.error < 3e-4 * coarse.error);
    CHECK(fine.steps < 15 * coarse.steps);
}

TEST_CASE("what decays fast does not make the steps small", "[modes]") {
    const Rotating mild{0.4, -1.5}, stiff{0.4, -1e7};
    const Result result = follow(stiff, 1e-4);
    CAPTURE(result.error, result.steps);
    CHECK(result.error < 1e-4);
    CHECK(result.steps < 3 * follow(mild, 1e-4).steps);
}

TEST_CASE("a system that is no number stops with its name", "[modes]") {
    const auto rates = [](double t) {
        const double value = t > 0.5 ? std::nan("") : 1.0;
        return std::vector<LinearRate>{{Eigen::MatrixXd::Constant(1, 1, value), Eigen::MatrixXd::Identity(1, 1)}};
    };
    LinearPropagation propagation(rates, 0.0, {Eigen::MatrixXd::Identity(1, 1)}, 1e-3, 1e-4);
    CHECK_THROWS_AS(propagation.advance(1.0), SolverError);
}
