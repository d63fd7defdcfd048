#include "boundary_integral/modes/linear_propagation.h"

#include <array>
#include <cmath>
#include <utility>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

// Radau IIA: nodes, weights, and the filter of the error estimate (Hairer & Wanner, eqs. IV.5.9, IV.8.17-8.20).
struct Radau {
    std::array<double, 3> node, defect;
    std::array<std::array<double, 3>, 3> weight;
    double gamma;
};

Radau make_radau() {
    const double s = std::sqrt(6.0);
    return {{(4 - s) / 10, (4 + s) / 10, 1.0},
            {-(13 + 7 * s) / 3, (-13 + 7 * s) / 3, -1.0 / 3},
            {{{(88 - 7 * s) / 360, (296 - 169 * s) / 1800, (-2 + 3 * s) / 225},
              {(296 + 169 * s) / 1800, (88 + 7 * s) / 360, (-2 - 3 * s) / 225},
              {(16 - s) / 36, (16 + s) / 36, 1.0 / 9}}},
            (6 + std::cbrt(81.0) - std::cbrt(9.0)) / 30};
}

const Radau radau = make_radau();

struct Trial {
    Eigen::MatrixXd value;
    double error = 0.0;  // relative
};

// One step of one system. Stage increments Z_i = h sum_j a_ij L_j (Y + Z_j).
Trial step_of(double h, const Eigen::MatrixXd& y, const LinearRate& now,
              const std::array<const LinearRate*, 3>& stage) {
    const Eigen::Index n = y.rows();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3 * n, 3 * n);
    std::array<Eigen::MatrixXd, 3> slopes;
    for (std::size_t j = 0; j < 3; ++j) slopes[j] = stage[j]->matrix * y;
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(3 * n, y.cols());
    for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i) * n;
        for (std::size_t j = 0; j < 3; ++j) {
            const double a = h * radau.weight[i][j];
            matrix.block(row, static_cast<Eigen::Index>(j) * n, n, n) -= a * stage[j]->matrix;
            z.middleRows(row, n) += a * slopes[j];
        }
    }
    LuFactors(std::move(matrix), "propagation").solve_in_place(z);

    // Filtered twice: what decays within the step then has no part in the estimate.
    Eigen::MatrixXd defect = Eigen::MatrixXd::Zero(n, y.cols());
    for (std::size_t i = 0; i < 3; ++i) {
        defect += radau.gamma * radau.defect[i] * z.middleRows(static_cast<Eigen::Index>(i) * n, n);
    }
    const LuFactors filter(Eigen::MatrixXd::Identity(n, n) - h * radau.gamma * now.matrix, "error estimate");
    Eigen::MatrixXd error = filter.solve(h * radau.gamma * (now.matrix * y) + defect);
    error = filter.solve(h * radau.gamma * (now.matrix * (y + error)) + defect);
    Trial trial{y + z.bottomRows(n)};
    trial.error = (stage[2]->root * error).norm() / (stage[2]->root * trial.value).norm();
    return trial;
}

}  // namespace

LinearPropagation::LinearPropagation(Rates rates, double begin, std::vector<Eigen::MatrixXd> start, double first_step,
                                     double tolerance, int threads)
    : rates_(std::move(rates)),
      time_(begin),
      tolerance_(tolerance),
      control_(first_step, 3),
      threads_(threads),
      values_(std::move(start)) {
    now_ = evaluate(begin);
}

std::vector<LinearRate> LinearPropagation::evaluate(double time) {
    ++evaluations_;
    return rates_(time);
}

void LinearPropagation::advance(double end) {
    while (time_ < end) attempt(control_.next(time_, end));
}

void LinearPropagation::attempt(const StepControl::Step& step) {
    const std::array<std::vector<LinearRate>, 3> stages = {evaluate(time_ + radau.node[0] * step.length),
                                                           evaluate(time_ + radau.node[1] * step.length),
                                                           evaluate(step.end)};
    std::vector<Trial> trials(values_.size());
    parallel_parts(static_cast<Eigen::Index>(values_.size()), threads_, [&](Eigen::Index begin, Eigen::Index stop) {
        for (Eigen::Index k = begin; k < stop; ++k) {
            const auto i = static_cast<std::size_t>(k);
            trials[i] = step_of(step.length, values_[i], now_[i], {&stages[0][i], &stages[1][i], &stages[2][i]});
        }
    });
    double error = 0.0;
    for (const Trial& trial : trials) error = trial.error <= error ? error : trial.error;  // keeps what is no number
    if (!control_.accepts(step, error / tolerance_)) return;
    for (std::size_t i = 0; i < trials.size(); ++i) values_[i] = std::move(trials[i].value);
    now_ = stages[2];
    time_ = step.end;
    ++steps_;
}

}  // namespace endoflow::boundary_integral
