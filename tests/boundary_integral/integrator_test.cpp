// The integrator on problems whose solutions are known.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/integration/cvode_failures.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "shared/numerics/level_crossing.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;

/// y1' = −1000 (y1 − cos y3) − sin y3,  y2' = −y2²,  y3' = 1: y1 = cos t, y2 = 1/(1 + t), y3 = t.
StiffProblem problem(double tolerance) {
    StiffProblem result;
    const auto at = std::make_shared<Eigen::VectorXd>();
    result.begin_step = [](const Eigen::VectorXd&) {};
    result.rate = [at](double /*time*/, const Eigen::VectorXd& y) -> Eigen::VectorXd {
        *at = y;
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

const StartingPoint beginning{0.0, 1e-6, Eigen::Vector3d(1, 1, 0)};
const StepLimits limits{1.0, 1e-14};

double error(const StiffIntegrator& i) {
    return std::hypot(i.state()[0] - std::cos(i.time()), i.state()[1] - 1 / (1 + i.time()));
}

void integrate(StiffIntegrator& i, double end) {
    while (i.time() < end) i.advance(end);
}

/// The error that stops the integration of a problem to t = 1.
SolverError failure_of(const StiffProblem& p, double& reached) {
    StiffIntegrator i(p, beginning, limits);
    try {
        integrate(i, 1);
    } catch (const SolverError& error) {
        reached = i.time();
        return error;
    }
    throw std::logic_error("the integration must not reach its end");
}

}  // namespace

TEST_CASE("the error follows the tolerance, and the order follows the error", "[integrator]") {
    const auto steps = [](double tolerance) {
        StiffIntegrator i(problem(tolerance), beginning, limits);
        integrate(i, 5);
        CHECK(i.time() == 5);
        CHECK(error(i) < 10 * tolerance);  // some hundred steps, each with an error below one tolerance, and damping
        return i.statistics();
    };
    const auto coarse = steps(1e-5), fine = steps(1e-9);
    // 1e4 in accuracy costs a first-order method 100 times the steps, a fifth-order one 5 times.
    CHECK(fine.steps < 10 * coarse.steps);
    CHECK(fine.steps_of_order[5] + fine.steps_of_order[4] > fine.steps / 2);
    long steps_of_all_orders = 0;
    for (const long count : fine.steps_of_order) steps_of_all_orders += count;
    CHECK(steps_of_all_orders == fine.steps);
}

TEST_CASE("a step may have the part of the error that is allowed when it starts", "[integrator]") {
    const double change = 1, tolerance = 1e-5, part = 0.01;
    StiffProblem p = problem(tolerance);
    p.allowed_part = [=](double time) { return time < change ? part : 1; };
    StiffIntegrator early(p, beginning, limits), strict(problem(part * tolerance), beginning, limits);
    while (early.time() < change) {
        early.advance(5);
        strict.advance(5);
        CHECK(early.time() == Approx(strict.time()).epsilon(1e-12));  // the same steps, but for round-off in weights
    }
    integrate(early, 5);
    integrate(strict, 5);
    CHECK(early.statistics().steps < strict.statistics().steps);
}

TEST_CASE("what is made for a step is made once for each attempted step", "[integrator]") {
    StiffProblem p = problem(1e-6);
    long begun = 0;
    p.begin_step = [&begun](const Eigen::VectorXd&) { ++begun; };
    StiffIntegrator i(p, beginning, limits);
    integrate(i, 5);
    const auto& s = i.statistics();
    CHECK(begun == s.steps_begun);
    CHECK(begun <= 1 + s.steps + s.error_test_failures + s.convergence_failures);  // 1: the rate at the start
    CHECK(s.jacobians <= begun);
    CHECK(s.rates >= s.steps);
}

TEST_CASE("between steps the solution is as accurate as at them", "[integrator]") {
    StiffIntegrator i(problem(1e-7), beginning, limits);
    while (i.time() < 3) i.advance(5);
    for (const double part : {0.1, 0.5, 0.9}) {
        const double time = i.time() - part * i.last_step();
        CHECK(i.state_at(time)[0] == Approx(std::cos(time)).margin(2e-6));
        CHECK(i.state_at(time)[1] == Approx(1 / (1 + time)).margin(2e-6));
    }
}

TEST_CASE("an integration resumed where it started anew makes the same steps", "[integrator]") {
    StiffIntegrator whole(problem(1e-6), beginning, limits);
    for (int k = 0; k < 40; ++k) whole.advance(5);
    const StartingPoint point = whole.start_anew();
    CHECK(point.time == whole.time());
    StiffIntegrator resumed(problem(1e-6), point, limits);
    for (int k = 0; k < 20; ++k) {
        whole.advance(5);
        resumed.advance(k < 10 ? 5 : 6);  // the end does not matter before it is near
    }
    CHECK(whole.time() == resumed.time());
    CHECK(whole.state() == resumed.state());
}

TEST_CASE("starting anew costs few steps and no accuracy", "[integrator]") {
    StiffIntegrator whole(problem(1e-6), beginning, limits), interrupted(problem(1e-6), beginning, limits);
    integrate(whole, 5);
    for (int k = 0; k < 30; ++k) interrupted.advance(5);
    (void)interrupted.start_anew();
    integrate(interrupted, 5);
    CHECK(error(interrupted) < 1e-5);
    // At most what it took to get there the first time: step and order grow to what they were.
    CHECK(interrupted.statistics().steps < whole.statistics().steps + 30);
}

TEST_CASE("a level is located inside a step", "[integrator]") {
    StiffIntegrator i(problem(1e-8), beginning, limits);
    const auto second = [](const Eigen::VectorXd& y) { return y[1]; };
    // As the neck of a membrane, which is not there at first.
    const auto late = [](const Eigen::VectorXd& y) {
        return y[1] > 0.501 ? std::numeric_limits<double>::infinity() : y[1];
    };
    std::optional<double> found, found_late;
    while (!found && i.time() < 5) {
        i.advance(5);
        const double begin = i.time() - i.last_step(), end = i.time();
        found = falls_below([&](double time) { return second(i.state_at(time)); }, begin, end, 0.5);
        found_late = falls_below([&](double time) { return late(i.state_at(time)); }, begin, end, 0.5);
    }
    REQUIRE(found);
    REQUIRE(found_late);
    CHECK(*found == Approx(1).epsilon(1e-6));  // 1/(1 + t) = 1/2
    CHECK(second(i.state_at(*found)) == Approx(0.5).epsilon(1e-12));
    CHECK(*found_late == Approx(*found).epsilon(1e-12));
}

TEST_CASE("a problem that cannot be integrated ends with a name", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    p.rate = [rate = p.rate](double time, const Eigen::VectorXd& y) -> Eigen::VectorXd {
        if (y[2] > 0.1) return Eigen::Vector3d::Constant(std::nan(""));
        return rate(time, y);
    };
    double reached = 0;
    const SolverError failure = failure_of(p, reached);
    CHECK(failure.name() == "step-size-underflow");
    CHECK(std::string(failure.what()).find("not finite") != std::string::npos);
    CHECK(reached == Approx(0.1).epsilon(1e-3));
}

TEST_CASE("a rate that is missing where the integration starts is named", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    p.rate = [](double, const Eigen::VectorXd&) -> Eigen::VectorXd {
        throw SolverError("injected", "no rate", "none");
    };
    double reached = 0;
    const SolverError failure = failure_of(p, reached);
    CHECK(failure.name() == "no-rate");
    CHECK(std::string(failure.what()).find("injected") != std::string::npos);
}

TEST_CASE("what is no failure of a step is passed on", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    int calls = 0;
    p.begin_step = [&calls](const Eigen::VectorXd&) {
        if (++calls == 5) throw IoError("the disk is full");
    };
    StiffIntegrator i(p, beginning, limits);
    CHECK_THROWS_AS(integrate(i, 1), IoError);
    CHECK(calls == 5);
}

TEST_CASE("a residual that is not finite costs one rejected step", "[integrator][faults]") {
    for (const double fault : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        StiffProblem p = problem(1e-6);
        int calls = 0;
        p.rate = [rate = p.rate, &calls, fault](double time, const Eigen::VectorXd& y) -> Eigen::VectorXd {
            Eigen::VectorXd value = rate(time, y);
            if (++calls == 40) value[1] = fault;
            return value;
        };
        StiffIntegrator i(p, beginning, limits);
        integrate(i, 1);
        CHECK(calls > 40);
        CHECK(error(i) < 1e-5);  // ten times the tolerance per step, as without the fault
    }
}

TEST_CASE("a singular matrix is left behind by a smaller step", "[integrator][faults]") {
    // 1 − h ∂F/∂y vanishes for the first step h of order 1.
    constexpr double first_step = 1e-3;
    StiffProblem p = problem(1e-6);
    int calls = 0;
    p.jacobian = [jacobian = p.jacobian, &calls]() -> Eigen::MatrixXd {
        if (++calls > 1) return jacobian();
        return Eigen::MatrixXd::Identity(3, 3) * (1 / first_step);
    };
    StiffIntegrator i(p, {0.0, first_step, beginning.y}, limits);
    integrate(i, 1);
    CHECK(error(i) < 1e-5);
    CHECK(i.statistics().convergence_failures + i.statistics().error_test_failures >= 1);
}

TEST_CASE("a factorisation that always fails ends with the name of the failure and a remedy", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    p.jacobian = [] { return Eigen::MatrixXd::Constant(3, 3, std::nan("")).eval(); };
    double reached = 1;
    const SolverError failure = failure_of(p, reached);
    CHECK(std::string(failure.what()).find("singular-matrix") != std::string::npos);
    CHECK(std::string(failure.what()).find("use more elements") != std::string::npos);
    CHECK(reached == 0);
    CHECK_THROWS_AS(LuFactors(Eigen::MatrixXd::Zero(3, 3), "zero"), SolverError);
}

TEST_CASE("ten failed steps in a row are survived", "[integrator][faults]") {
    StiffProblem p = problem(1e-6);
    int calls = 0;
    p.begin_step = [&calls](const Eigen::VectorXd&) {
        ++calls;
        if (calls > 30 && calls <= 40) throw SolverError("injected", "nothing", "none");
    };
    StiffIntegrator i(p, beginning, {1, 1e-16});
    integrate(i, 1);
    CHECK(error(i) < 1e-5);
}

TEST_CASE("every failure that CVODE can report has a name and a remedy", "[integrator][faults]") {
    for (int flag = -1; flag >= -32; --flag) {
        CAPTURE(flag);
        try {
            throw_cvode_failure(flag, 0.5, "the reason");
        } catch (const SolverError& error) {
            const std::string text = error.what();
            CHECK(text.find("at t = 0.5 µs (the reason); ") != std::string::npos);
            CHECK(text.find("; ") + 2 < text.size());
        }
    }
    CHECK_NOTHROW(require_success(CV_TSTOP_RETURN, "CVode"));
    CHECK_THROWS_AS(require_success(CV_MEM_FAIL, "CVodeInit"), SolverError);
}
