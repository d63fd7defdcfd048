#include "boundary_integral/evolution/stiff_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "boundary_integral/flow/dense_solver.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int highest_order = StepHistory::highest_order;
constexpr int most_iterations = 5;
// Errors of the iteration enter the estimate of the step's error: keep them well below it.
constexpr double iteration_tolerance = 0.01;
constexpr double negligible_change = 1e-5;  // round-off of a solution at rest may well be larger than nothing

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

// Coefficients of the formulas: sum_{j<=k} (1/j) nabla^j y_{n+1} - kappa_k gamma_k (y_{n+1} - predicted) = h F
struct Formulas {
    std::array<double, highest_order + 1> gamma{}, alpha{};
    std::array<double, highest_order + 2> error{};

    Formulas() {
        constexpr std::array kappa = {0.0, -0.1850, -1.0 / 9.0, -0.0823, -0.0415, 0.0};
        for (int k = 1; k <= highest_order; ++k) gamma[at(k)] = gamma[at(k - 1)] + 1.0 / k;
        for (int k = 0; k <= highest_order; ++k) {
            alpha[at(k)] = (1.0 - kappa[at(k)]) * gamma[at(k)];
            error[at(k)] = kappa[at(k)] * gamma[at(k)] + 1.0 / (k + 1);
        }
    }
};

const Formulas& formulas() {
    static const Formulas result;
    return result;
}

// Backward differences of the interpolating polynomial's values at steps `factor` times as long, from values.
Eigen::MatrixXd rescaling(int order, double factor) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(order + 1, order + 1);
    matrix.row(0).setOnes();
    for (int i = 1; i <= order; ++i) {
        for (int j = 1; j <= order; ++j) matrix(i, j) = matrix(i - 1, j) * (i - 1 - factor * j) / i;
    }
    return matrix;
}

std::string microseconds(double time) {
    return std::to_string(time) + " us";
}

}  // namespace

StepHistory StepHistory::start(double time, double step, const Eigen::VectorXd& y, const Eigen::VectorXd& rate) {
    StepHistory history;
    history.time = time;
    history.step = step;
    history.differences = Eigen::MatrixXd::Zero(y.size(), highest_order + 3);
    history.differences.col(0) = y;
    history.differences.col(1) = step * rate;
    return history;
}

StiffIntegrator::StiffIntegrator(StiffProblem problem, StepHistory history, const StepLimits& limits)
    : problem_(std::move(problem)), history_(std::move(history)), limits_(limits) {}

void StiffIntegrator::scale_step(double factor) {
    const int order = history_.order;
    const Eigen::MatrixXd change = rescaling(order, factor) * rescaling(order, 1.0);
    history_.differences.leftCols(order + 1) = (history_.differences.leftCols(order + 1) * change).eval();
    history_.step *= factor;
    history_.equal_steps = 0;
}

double StiffIntegrator::norm(const Eigen::VectorXd& difference) const {
    return difference.cwiseQuotient(problem_.error_scales).norm() / std::sqrt(static_cast<double>(difference.size()));
}

// Newton's iteration for the difference d:  d - c F(predicted + d) + psi = 0,  c = h/alpha.
std::optional<StiffIntegrator::Correction> StiffIntegrator::correct(const Eigen::VectorXd& predicted) {
    const int order = history_.order;
    const double scale = 1.0 / formulas().alpha[at(order)];
    const double c = history_.step * scale;
    Eigen::VectorXd psi = Eigen::VectorXd::Zero(predicted.size());
    for (int k = 1; k <= order; ++k) psi += scale * formulas().gamma[at(k)] * history_.differences.col(k);

    const auto rate = [&](const Eigen::VectorXd& y) {
        ++statistics_.rates;
        Eigen::VectorXd value = problem_.rate(y);
        if (!value.allFinite()) throw SolverError("not-finite", "the rate of change is not finite", "report this case");
        return value;
    };
    problem_.begin_step(predicted);
    Correction correction{Eigen::VectorXd::Zero(predicted.size()), 0};
    Eigen::VectorXd residual = c * rate(predicted) - psi;
    ++statistics_.jacobians;
    Eigen::MatrixXd matrix = -c * problem_.jacobian();
    matrix.diagonal().array() += 1.0;
    const LuFactors factors(std::move(matrix), "iteration");
    double before = 0.0;
    for (int i = 1; i <= most_iterations; ++i) {
        const Eigen::VectorXd change = factors.solve(residual);
        correction.difference += change;
        correction.iterations = i;
        const double size = norm(change);
        const double contraction = i > 1 ? size / before : 0.0;
        if (size < negligible_change) return correction;
        if (!std::isfinite(size) || contraction >= 1.0) return std::nullopt;
        // The first change is the whole correction: only a second one tells how fast the iteration converges.
        if (i > 1 && contraction / (1.0 - contraction) * size < iteration_tolerance) return correction;
        before = size;
        residual = c * rate(predicted + correction.difference) - psi - correction.difference;
    }
    return std::nullopt;
}

void StiffIntegrator::advance(double end) {
    if (history_.step > limits_.largest) scale_step(limits_.largest / history_.step);
    std::string failure = "the error estimate stays too large";
    for (;;) {
        const double left = end - history_.time;
        if (history_.step > left) {
            scale_step(left / history_.step);
        } else if (history_.step < limits_.smallest) {
            throw SolverError(
                "step-size-underflow",
                "no time step is small enough at t = " + microseconds(history_.time) + " (" + failure + ")",
                "use more elements, or a looser time.tolerance");
        }
        std::optional<Correction> correction;
        const Eigen::VectorXd predicted = history_.differences.leftCols(history_.order + 1).rowwise().sum();
        try {
            correction = correct(predicted);
            if (!correction) failure = "Newton's iteration does not converge";
        } catch (const std::exception& error) {
            failure = error.what();
        }
        if (!correction) {
            ++statistics_.convergence_failures;
            scale_step(0.5);
            continue;
        }
        const double error = norm(correction->difference) * formulas().error[at(history_.order)];
        if (error <= 1.0) {
            last_step_ = history_.step;
            last_order_ = history_.order;
            const bool last = history_.step * (1.0 + 1e-12) >= left;
            accept(*correction);
            if (last) history_.time = end;
            choose_order_and_step(*correction);
            return;
        }
        ++statistics_.error_test_failures;
        failure = "the error estimate stays too large";
        scale_step(std::max(0.2, 0.9 * std::pow(error, -1.0 / (history_.order + 1))));
    }
}

void StiffIntegrator::accept(const Correction& correction) {
    ++statistics_.steps;
    const int order = history_.order;
    auto& differences = history_.differences;
    history_.time += history_.step;
    ++history_.equal_steps;
    differences.col(order + 2) = correction.difference - differences.col(order + 1);
    differences.col(order + 1) = correction.difference;
    for (int k = order; k >= 0; --k) differences.col(k) += differences.col(k + 1);
}

void StiffIntegrator::choose_order_and_step(const Correction& correction) {
    const int order = history_.order;
    if (history_.equal_steps < order + 1) return;
    const auto factor = [&](int tried, const Eigen::VectorXd& difference) {
        const double error = formulas().error[at(tried)] * norm(difference);
        return std::pow(std::max(error, 1e-10), -1.0 / (tried + 1));
    };
    int best = order;
    double largest = factor(order, correction.difference);
    if (order > 1) {
        const double lower = factor(order - 1, history_.differences.col(order));
        if (lower > largest) std::tie(best, largest) = std::pair(order - 1, lower);
    }
    if (order < highest_order) {
        const double higher = factor(order + 1, history_.differences.col(order + 2));
        if (higher > largest) std::tie(best, largest) = std::pair(order + 1, higher);
    }
    history_.order = best;
    constexpr double most_growth = 10.0;
    const double safety =
        0.9 * (2.0 * most_iterations + 1.0) / (2.0 * most_iterations + static_cast<double>(correction.iterations));
    scale_step(std::min(most_growth, safety * largest));
}

Eigen::VectorXd StiffIntegrator::state_at(double time) const {
    // Newton's backward form on the present grid; the polynomial does not depend on the grid's step.
    Eigen::VectorXd value = history_.differences.col(0);
    double factor = 1.0;
    for (int k = 0; k < history_.order; ++k) {
        factor *= (time - history_.time + k * history_.step) / ((k + 1) * history_.step);
        value += factor * history_.differences.col(k + 1);
    }
    return value;
}

std::optional<double> StiffIntegrator::falls_below(const std::function<double(const Eigen::VectorXd&)>& quantity,
                                                   double level) const {
    double above = history_.time - last_step_;
    double below = history_.time;
    double value_above = quantity(state_at(above)) - level;
    double value_below = quantity(state()) - level;
    if (value_below > 0.0) return std::nullopt;
    if (!(value_above > 0.0)) return above;  // it fell below at the very end of the step before
    // Illinois variant of the false position.
    int stuck = 0;
    for (int i = 0; i < 100 && below - above > 1e-14 * (1.0 + history_.time); ++i) {
        double middle = 0.5 * (above + below);
        if (std::isfinite(value_above)) {
            middle = std::clamp(below - value_below * (below - above) / (value_below - value_above), above, below);
        }
        const double value = quantity(state_at(middle)) - level;
        if (value > 0.0) {
            above = middle;
            value_above = value;
            if (stuck == 1) value_below *= 0.5;
            stuck = 1;
        } else {
            below = middle;
            value_below = value;
            if (value == 0.0) break;
            if (stuck == -1) value_above *= 0.5;
            stuck = -1;
        }
    }
    return below;
}

}  // namespace endoflow::boundary_integral
