#include "statics/piecewise_solution.h"

#include <algorithm>
#include <cmath>

namespace endoflow::statics {

namespace {

/// y^(k) on each element, in units of the scales: (n, N). The slopes are polynomials of degree k − 1.
Eigen::MatrixXd highest_derivatives(const PiecewiseSolution& solution, const GaussRule& rule,
                                    const Eigen::VectorXd& scales) {
    Eigen::MatrixXd result(solution.nodes.rows(), static_cast<Eigen::Index>(solution.elements()));
    const Eigen::VectorXd leading = rule.coefficients.row(rule.points - 1).transpose() * std::tgamma(rule.points);
    for (std::size_t i = 0; i < solution.elements(); ++i)
        result.col(static_cast<Eigen::Index>(i)) =
            (solution.slopes[i] * leading).cwiseQuotient(scales) / std::pow(solution.width(i), rule.points - 1);
    return result;
}

/// (|y^(k+1)|)^(1/(k+1)) on each element from the jumps of y^(k) at its ends.
std::vector<double> monitor_function(const PiecewiseSolution& solution, const GaussRule& rule,
                                     const Eigen::VectorXd& scales) {
    const Eigen::MatrixXd derivatives = highest_derivatives(solution, rule, scales);
    const std::size_t n = solution.elements();
    const auto jump = [&](std::size_t i) {  // between elements i and i + 1
        const auto left = static_cast<Eigen::Index>(i);
        const double distance = 0.5 * (solution.width(i) + solution.width(i + 1));
        return (derivatives.col(left + 1) - derivatives.col(left)).cwiseAbs().maxCoeff() / distance;
    };
    std::vector<double> monitor(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double before = jump(i == 0 ? 0 : i - 1), after = jump(std::min(i, n - 2));
        monitor[i] = std::pow(std::max(before, after), 1.0 / (rule.points + 1));
    }
    return monitor;
}

}  // namespace

std::size_t PiecewiseSolution::element_of(double x) const {
    const auto above = std::upper_bound(mesh.begin() + 1, mesh.end() - 1, x);
    return static_cast<std::size_t>(above - mesh.begin()) - 1;
}

double PiecewiseSolution::weight(std::size_t point) const {
    const double before = point == 0 ? 0 : width(point - 1), after = point == elements() ? 0 : width(point);
    return 0.5 * (before + after);
}

void PiecewiseSolution::add(double factor, const PiecewiseSolution& direction) {
    nodes += factor * direction.nodes;
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += factor * direction.slopes[i];
    globals += factor * direction.globals;
    parameter += factor * direction.parameter;
}

void PiecewiseSolution::scale(double factor) {
    nodes *= factor;
    for (auto& slope : slopes) slope *= factor;
    globals *= factor;
    parameter *= factor;
}

Eigen::VectorXd evaluate(const PiecewiseSolution& solution, const GaussRule& rule, double x) {
    const std::size_t i = solution.element_of(x);
    const double h = solution.width(i), xi = (x - solution.mesh[i]) / h;
    return solution.nodes.col(static_cast<Eigen::Index>(i)) + h * (solution.slopes[i] * rule.integrals(xi));
}

Eigen::VectorXd slope_at(const PiecewiseSolution& solution, const GaussRule& rule, double x) {
    const std::size_t i = solution.element_of(x);
    return solution.slopes[i] * rule.values((x - solution.mesh[i]) / solution.width(i));
}

PiecewiseSolution sample(const std::vector<double>& mesh, const GaussRule& rule,
                         const std::function<Eigen::VectorXd(double)>& y,
                         const std::function<Eigen::VectorXd(double)>& slope, const Eigen::VectorXd& globals,
                         double parameter) {
    PiecewiseSolution result{mesh, {}, {}, globals, parameter};
    const Eigen::Index states = y(mesh.front()).size();
    result.nodes.resize(states, static_cast<Eigen::Index>(mesh.size()));
    for (std::size_t i = 0; i < mesh.size(); ++i) result.nodes.col(static_cast<Eigen::Index>(i)) = y(mesh[i]);
    for (std::size_t i = 0; i + 1 < mesh.size(); ++i) {
        result.slopes.emplace_back(states, rule.points);
        for (int j = 0; j < rule.points; ++j)
            result.slopes[i].col(j) = slope(mesh[i] + (mesh[i + 1] - mesh[i]) * rule.nodes(j));
    }
    return result;
}

PiecewiseSolution resample(const PiecewiseSolution& solution, const GaussRule& rule, const std::vector<double>& mesh,
                           const GaussRule& new_rule) {
    const auto value = [&](double x) { return evaluate(solution, rule, x); };
    const auto slope = [&](double x) { return slope_at(solution, rule, x); };
    return sample(mesh, new_rule, value, slope, solution.globals, solution.parameter);
}

PiecewiseSolution interpolate(const PiecewiseSolution& solution, const GaussRule& rule,
                              const std::vector<double>& mesh) {
    return resample(solution, rule, mesh, rule);
}

std::vector<double> equidistributed_mesh(const PiecewiseSolution& solution, const GaussRule& rule,
                                         const Eigen::VectorXd& state_scales, std::size_t elements) {
    const std::vector<double> monitor = monitor_function(solution, rule, state_scales);
    const std::size_t n = solution.elements();
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += monitor[i] * solution.width(i);
    // Smoothed over neighbours and kept above a part of its mean, so that neighbouring elements differ moderately.
    std::vector<double> density(n), cumulated(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n - 1);
        density[i] = std::max({monitor[before], monitor[i], monitor[after], 0.3 * mean, 1e-12});
        cumulated[i + 1] = cumulated[i] + density[i] * solution.width(i);
    }
    std::vector<double> mesh(elements + 1, 0);
    mesh[elements] = 1;
    for (std::size_t j = 1, i = 0; j < elements; ++j) {
        const double wanted = cumulated[n] * static_cast<double>(j) / static_cast<double>(elements);
        while (cumulated[i + 1] < wanted) ++i;
        mesh[j] = solution.mesh[i] + (wanted - cumulated[i]) / density[i];
    }
    return mesh;
}

std::vector<double> halved_mesh(const std::vector<double>& mesh) {
    std::vector<double> result{mesh.front()};
    for (std::size_t i = 0; i + 1 < mesh.size(); ++i) {
        result.push_back(0.5 * (mesh[i] + mesh[i + 1]));
        result.push_back(mesh[i + 1]);
    }
    return result;
}

double inner_product(const PiecewiseSolution& a, const PiecewiseSolution& b, const BoundaryValueProblem& problem) {
    double sum = 0;
    for (std::size_t i = 0; i < a.mesh.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        sum +=
            a.weight(i) *
            (a.nodes.col(column).array() * b.nodes.col(column).array() / problem.state_scales.array().square()).sum();
    }
    sum += (a.globals.array() * b.globals.array() / problem.global_scales.array().square()).sum();
    return sum + a.parameter * b.parameter / (problem.parameter_scale * problem.parameter_scale);
}

double largest_entry(const PiecewiseSolution& direction, const BoundaryValueProblem& problem) {
    const double states = (problem.state_scales.cwiseInverse().asDiagonal() * direction.nodes).cwiseAbs().maxCoeff();
    const double globals = direction.globals.cwiseQuotient(problem.global_scales).lpNorm<Eigen::Infinity>();
    return std::max({states, globals, std::abs(direction.parameter) / problem.parameter_scale});
}

}  // namespace endoflow::statics
