// The integrator on problems whose solutions are known.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "boundary_integral/evolution/stiff_integrator.h"
#include "boundary_integral/flow/dense_solver.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;

// y1' = -1000 (y1 - cos t) - sin t,  y2' = -y2^2: y1 = cos t, y2 = 1/(1 + t).
StiffProblem problem(double tolerance) {
    StiffProblem result;
    const auto at = std::make_shared<Eigen::VectorXd>();
    result.begin_step = [](const Eigen::VectorXd&) {};
    result.rate = [at](const Eigen::VectorXd& y) -> Eigen::VectorXd {
        *at = y;
        // y3 is the time.
        return Eigen::Vector3d(-1000 * (y[0] - std::cos(y[2])) - std::sin(y[2]), -y[1] * y[1], 1.0);
    };
    result.jacobian = [at] {
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, 3);
        jacobian(0, 0) = -1000;
        jacobian(0, 2) = -1000 * std::sin((*at)[2]) - std::cos((*at)[2]);
        jacobian(1, 1) = -2 * (*at)[1];
        return jacobian;
    };
    result.error_scales = Eigen::Vector3d::Constant(tolerance);
    return result;
}

StiffIntegrator integrator(double tolerance) {
    StiffProblem p = problem(tolerance);
    const Eigen::Vector3d y(1, 1, 0);
    const Eigen::VectorXd rate = p.rate(y);
    return {p, StepHistory::start(0, 1e-6, y, rate), {1, 1e-14}};
}

double error_at_end(double tolerance, long& steps) {
    StiffIntegrator i = integrator(tolerance);
    while (i.time() < 5) i.advance(5);
    CHECK(i.time() == 5);
    steps = i.statistics().steps;
    return std::hypot(i.state()[0] - std::cos(5.0), i.state()[1] - 1 / 6.0);
}

}  // namespace

TEST_CASE("the error follows the tolerance, and the order follows the error", "[integrator]") {
    long coarse = 0, fine = 0;
    CHECK(error_at_end(1e-5, coarse) < 1e-4);
    CHECK(error_at_end(1e-9, fine) < 1e-8);
    // 1e4 in accuracy costs a first-order method 100 times the steps, a fifth-order one 5 times.
    CHECK(fine < 10 * coarse);
}

TEST_CASE("between steps the solution is as accurate as at them", "[integrator]") {
    StiffIntegrator i = integrator(1e-7);
    while (i.time() < 3) i.advance(5);
    for (const double part : {0.1, 0.5, 0.9}) {
        const double time = i.time() - part * i.last_step();
        CHECK(i.state_at(time)[0] == Approx(std::cos(time)).margin(2e-6));
        CHECK(i.state_at(time)[1] == Approx(1 / (1 + time)).margin(2e-6));
    }
}

TEST_CASE("an integration resumed from its history makes the same steps", "[integrator]") {
    StiffIntegrator whole = integrator(1e-6);
    for (int k = 0; k < 40; ++k) whole.advance(5);
    const StepHistory stored = whole.history();
    StiffIntegrator resumed(problem(1e-6), stored, {1, 1e-14});
    for (int k = 0; k < 20; ++k) {
        whole.advance(5);
        resumed.advance(5);
    }
    CHECK(whole.time() == resumed.time());
    CHECK(whole.state() == resumed.state());
}

TEST_CASE("a level is located inside a step", "[integrator]") {
    StiffIntegrator i = integrator(1e-8);
    const auto second = [](const Eigen::VectorXd& y) { return y[1]; };
    std::optional<double> found;
    while (!found && i.time() < 5) {
        i.advance(5);
        found = i.falls_below(second, 0.5);
    }
    REQUIRE(found);
    CHECK(*found == Approx(1).epsilon(1e-6));  // 1/(1 + t) = 1/2
    CHECK(second(i.state_at(*found)) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("a problem that cannot be integrated ends with a name", "[integrator]") {
    StiffProblem p = problem(1e-6);
    const auto rate = p.rate;
    p.rate = [rate](const Eigen::VectorXd& y) -> Eigen::VectorXd {
        if (y[2] > 0.1) return Eigen::Vector3d::Constant(std::nan(""));
        return rate(y);
    };
    const Eigen::Vector3d y(1, 1, 0);
    StiffIntegrator i(p, StepHistory::start(0, 1e-6, y, rate(y)), {1, 1e-12});
    try {
        while (i.time() < 1) i.advance(1);
        FAIL("the rate is not finite beyond 0.1");
    } catch (const SolverError& error) {
        CHECK(error.name() == "step-size-underflow");
        CHECK(std::string(error.what()).find("not finite") != std::string::npos);
    }
    CHECK(i.time() == Approx(0.1).epsilon(1e-3));
}

namespace {

// Integrates to t = 1 and returns the error there.
double error_at_one(StiffIntegrator& i) {
    while (i.time() < 1) i.advance(1);
    return std::hypot(i.state()[0] - std::cos(1.0), i.state()[1] - 0.5);
}

StiffIntegrator start(const StiffProblem& p, double first_step) {
    const Eigen::Vector3d y(1, 1, 0);
    return {p, StepHistory::start(0, first_step, y, problem(1e-6).rate(y)), {1, 1e-12}};
}

}  // namespace

TEST_CASE("a residual that is not finite costs one rejected step", "[integrator][faults]") {
    for (const double fault : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        StiffProblem p = problem(1e-6);
        int calls = 0;
        p.rate = [rate = p.rate, &calls, fault](const Eigen::VectorXd& y) -> Eigen::VectorXd {
            Eigen::VectorXd value = rate(y);
            if (++calls == 40) value[1] = fault;
            return value;
        };
        StiffIntegrator i = start(p, 1e-6);
        CHECK(error_at_one(i) < 1e-5);  // ten times the tolerance per step, as without the fault
        CHECK(i.statistics().convergence_failures == 1);
    }
}

TEST_CASE("a singular matrix is left behind by a smaller step", "[integrator][faults]") {
    // 1 − (h/α) ∂F/∂y vanishes for the first step h; α = 1 + 0.185 at order 1.
    constexpr double first_step = 1e-3;
    StiffProblem p = problem(1e-6);
    int calls = 0;
    p.jacobian = [jacobian = p.jacobian, &calls]() -> Eigen::MatrixXd {
        if (++calls > 1) return jacobian();
        return Eigen::MatrixXd::Identity(3, 3) / (first_step * (1 / 1.185));
    };
    StiffIntegrator i = start(p, first_step);
    CHECK(error_at_one(i) < 1e-5);
    CHECK(i.statistics().convergence_failures >= 1);
}

TEST_CASE("a factorisation that always fails ends with the name of the failure and a remedy", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    p.jacobian = [] { return Eigen::MatrixXd::Constant(3, 3, std::nan("")).eval(); };
    StiffIntegrator i = start(p, 1e-6);
    try {
        i.advance(1);
        FAIL("the matrix is not finite");
    } catch (const SolverError& error) {
        CHECK(error.name() == "step-size-underflow");
        CHECK(std::string(error.what()).find("singular-matrix") != std::string::npos);
        CHECK(std::string(error.what()).find("use more elements") != std::string::npos);
    }
    CHECK(i.state() == Eigen::Vector3d(1, 1, 0));  // what had been reached stands
    CHECK_THROWS_AS(LuFactors(Eigen::MatrixXd::Zero(3, 3), "zero"), SolverError);
}

TEST_CASE("ten failed steps in a row are survived", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    int calls = 0;
    p.begin_step = [&calls](const Eigen::VectorXd&) {
        ++calls;
        if (calls > 30 && calls <= 40) throw std::runtime_error("injected");
    };
    StiffIntegrator i = start(p, 1e-6);
    CHECK(error_at_one(i) < 1e-5);
    CHECK(i.statistics().convergence_failures == 10);
}
