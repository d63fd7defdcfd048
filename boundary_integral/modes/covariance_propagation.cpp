#include "boundary_integral/modes/covariance_propagation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/modes/lyapunov_solver.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

// ARK3(2)4L[2]SA: an explicit stage and three implicit ones with the same diagonal; the last is the step's end.
struct ImplicitStages {
    double diagonal;
    std::array<double, 4> node;
    std::array<std::array<double, 3>, 4> weight;  // below the diagonal
    std::array<double, 4> defect;                 // weights of the step less those of its embedded method of order 2
};

ImplicitStages make_stages() {
    constexpr double diagonal = 1767732205903.0 / 4055673282236.0;
    constexpr std::array<double, 4> node = {0.0, 2.0 * diagonal, 0.6, 1.0};
    // Stages of order 2, a step of order 3: sum b = 1, sum b c = 1/2, sum b c^2 = 1/3.
    constexpr double middle = node[2] * (0.5 * node[2] - diagonal) / node[1];
    constexpr double first = 0.5 - diagonal, second = 1.0 / 3.0 - diagonal;  // of the two stages between
    constexpr double b2 = (second - first * node[2]) / (node[1] * (node[1] - node[2]));
    constexpr double b3 = (second - first * node[1]) / (node[2] * (node[2] - node[1]));
    constexpr double b1 = 1.0 - b2 - b3 - diagonal;
    constexpr std::array<double, 4> embedded = {2756255671327.0 / 12835298489170.0,
                                                -10771552573575.0 / 22201958757719.0,
                                                9247589265047.0 / 10645013368117.0, 2193209047091.0 / 5459859503100.0};
    return {diagonal,
            node,
            {{{0, 0, 0}, {diagonal, 0, 0}, {node[2] - middle - diagonal, middle, 0}, {b1, b2, b3}}},
            {b1 - embedded[0], b2 - embedded[1], b3 - embedded[2], diagonal - embedded[3]}};
}

const ImplicitStages sdirk = make_stages();

struct CovarianceTrial {
    Covariance value, slope;
    double error = 0.0;  // relative
};

double ratio(const Eigen::MatrixXd& error, const Eigen::MatrixXd& value) {
    const double size = error.norm();
    return size == 0.0 ? 0.0 : size / value.norm();
}

// One step of one system. Stages X_i - h gamma (L_i X_i + X_i L_i^T) = G + h sum_{j < i} a_ij K_j + h gamma D_i, and
// the like of F. In the estimates what decays within the step has no part: they are solutions for such right-hand
// sides, too.
CovarianceTrial covariance_step(double h, const Covariance& start, const Covariance& slope,
                                const std::array<const NoisyRate*, 3>& stage) {
    const double implicit = h * sdirk.diagonal;
    const Eigen::Index n = start.gathered.rows();
    std::array<Covariance, 4> slopes;
    slopes[0] = slope;
    CovarianceTrial trial;
    for (std::size_t i = 1; i < 4; ++i) {
        const NoisyRate& rate = *stage[i - 1];
        const LyapunovSolver solver(rate.linear.matrix);
        const LuFactors factors(Eigen::MatrixXd::Identity(n, n) - implicit * rate.linear.matrix, "covariance");
        Covariance before = start;
        for (std::size_t j = 0; j < i; ++j) {
            before.inherited_root += h * sdirk.weight[i][j] * slopes[j].inherited_root;
            before.gathered += h * sdirk.weight[i][j] * slopes[j].gathered;
        }
        trial.value = {factors.solve(before.inherited_root),
                       solver.solve(implicit, before.gathered + implicit * rate.noise)};
        slopes[i] = {(trial.value.inherited_root - before.inherited_root) / implicit,
                     (trial.value.gathered - before.gathered) / implicit};
        if (i < 3) continue;
        Covariance defect = {Eigen::MatrixXd::Zero(n, start.inherited_root.cols()), Eigen::MatrixXd::Zero(n, n)};
        for (std::size_t j = 0; j < 4; ++j) {
            defect.inherited_root += h * sdirk.defect[j] * slopes[j].inherited_root;
            defect.gathered += h * sdirk.defect[j] * slopes[j].gathered;
        }
        const Eigen::MatrixXd& root = rate.linear.root;
        trial.error = std::max(ratio(root * factors.solve(defect.inherited_root), root * trial.value.inherited_root),
                               ratio(root * solver.solve(implicit, defect.gathered) * root.transpose(),
                                     root * trial.value.total() * root.transpose()));
    }
    trial.slope = slopes[3];
    return trial;
}

}  // namespace

CovariancePropagation::CovariancePropagation(Rates rates, double begin, std::vector<Covariance> start,
                                             double first_step, double tolerance, int threads)
    : rates_(std::move(rates)),
      time_(begin),
      tolerance_(tolerance),
      threads_(threads),
      control_(first_step, 2),
      values_(std::move(start)) {
    const std::vector<NoisyRate> now = rates_(begin);
    for (std::size_t k = 0; k < values_.size(); ++k) {
        const Eigen::MatrixXd& matrix = now[k].linear.matrix;
        const Eigen::MatrixXd product = matrix * values_[k].gathered;
        slopes_.push_back({matrix * values_[k].inherited_root, product + product.transpose() + now[k].noise});
    }
}

void CovariancePropagation::advance(double end, const std::function<void()>& after_step) {
    while (time_ < end) {
        if (attempt(control_.next(time_, end))) after_step();
    }
}

bool CovariancePropagation::attempt(const StepControl::Step& step) {
    const std::array<std::vector<NoisyRate>, 3> stages = {
        rates_(time_ + sdirk.node[1] * step.length), rates_(time_ + sdirk.node[2] * step.length), rates_(step.end)};
    std::vector<CovarianceTrial> trials(values_.size());
    parallel_parts(static_cast<Eigen::Index>(values_.size()), threads_, [&](Eigen::Index begin, Eigen::Index stop) {
        for (Eigen::Index k = begin; k < stop; ++k) {
            const auto i = static_cast<std::size_t>(k);
            trials[i] =
                covariance_step(step.length, values_[i], slopes_[i], {&stages[0][i], &stages[1][i], &stages[2][i]});
        }
    });
    double error = 0.0;
    for (const CovarianceTrial& trial : trials)
        error = trial.error <= error ? error : trial.error;  // keeps what is no number
    if (!control_.accepts(step, error / tolerance_)) return false;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        values_[i] = std::move(trials[i].value);
        slopes_[i] = std::move(trials[i].slope);
    }
    time_ = step.end;
    ++steps_;
    return true;
}

}  // namespace endoflow::boundary_integral
