#include "statics/linearised_collocation.h"

#include <cmath>

namespace endoflow::statics {

namespace {

/// The states at the Gauss points of an element: y_i + h A K, (n, k).
Eigen::MatrixXd stage_states(const PiecewiseSolution& solution, const GaussRule& rule, std::size_t element) {
    return (solution.width(element) * solution.slopes[element] * rule.stages.transpose()).colwise() +
           solution.nodes.col(static_cast<Eigen::Index>(element));
}

double stage_position(const PiecewiseSolution& solution, const GaussRule& rule, std::size_t element, int stage) {
    return solution.mesh[element] + solution.width(element) * rule.nodes(stage);
}

/// For central differences by the parameter: error about 1e-10 of the parameter's scale.
double parameter_step(const BoundaryValueProblem& problem) {
    return 1e-5 * problem.parameter_scale;
}

}  // namespace

CollocationDefect defect(const BoundaryValueProblem& problem, const GaussRule& rule, const PiecewiseSolution& solution,
                         const BranchCondition& condition) {
    const Equations equations = problem.at(solution.parameter);
    CollocationDefect result;
    result.continuity.resize(problem.states(), static_cast<Eigen::Index>(solution.elements()));
    for (std::size_t i = 0; i < solution.elements(); ++i) {
        const Eigen::MatrixXd states = stage_states(solution, rule, i);
        Eigen::MatrixXd stages = -solution.slopes[i];
        for (int j = 0; j < rule.points; ++j)
            stages.col(j) +=
                equations.slope(stage_position(solution, rule, i, j), states.col(j), solution.globals).value;
        result.stages.push_back(std::move(stages));
        const auto column = static_cast<Eigen::Index>(i);
        result.continuity.col(column) = solution.nodes.col(column) - solution.nodes.col(column + 1) +
                                        solution.width(i) * (solution.slopes[i] * rule.weights);
    }
    result.conditions =
        -equations.conditions(solution.nodes.col(0), solution.nodes.rightCols<1>(), solution.globals).value;
    PiecewiseSolution moved = solution;
    moved.add(-1, condition.origin);
    result.branch = condition.distance - inner_product(condition.normal, moved, problem);
    return result;
}

LinearisedCollocation::LinearisedCollocation(const BoundaryValueProblem& problem, const GaussRule& rule,
                                             const PiecewiseSolution& solution, const BranchCondition& condition)
    : problem_(problem),
      rule_(rule),
      solution_(solution),
      states_(problem.states()),
      globals_(problem.globals()),
      first_global_(states_ * static_cast<Eigen::Index>(solution.mesh.size())),
      unknowns_(first_global_ + globals_ + 1) {
    const double step = parameter_step(problem);
    const Equations here = problem.at(solution.parameter), above = problem.at(solution.parameter + step),
                    below = problem.at(solution.parameter - step);
    for (std::size_t i = 0; i < solution.elements(); ++i) assemble_element(here, above, below, step, i);
    assemble_conditions(here, above, below, step);
    assemble_branch_condition(condition.normal);
    for (const auto& entry : triplets_) usable_ = usable_ && std::isfinite(entry.value());
    if (!usable_) return;
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    factors_.compute(matrix);
    usable_ = factors_.info() == Eigen::Success;
}

void LinearisedCollocation::assemble_element(const Equations& here, const Equations& above, const Equations& below,
                                             double step, std::size_t index) {
    const int k = rule_.points;
    const double h = solution_.width(index);
    const Eigen::MatrixXd y = stage_states(solution_, rule_, index);
    Eigen::MatrixXd stages = Eigen::MatrixXd::Identity(states_ * k, states_ * k);
    Eigen::MatrixXd by_node(states_ * k, states_), by_global(states_ * k, globals_ + 1);
    for (int j = 0; j < k; ++j) {
        const double x = stage_position(solution_, rule_, index, j);
        const SlopeValues slope = here.slope(x, y.col(j), solution_.globals);
        for (int l = 0; l < k; ++l)
            stages.block(j * states_, l * states_, states_, states_) -= h * rule_.stages(j, l) * slope.by_state;
        by_node.middleRows(j * states_, states_) = slope.by_state;
        by_global.block(j * states_, 0, states_, globals_) = slope.by_global;
        by_global.block(j * states_, globals_, states_, 1) =
            (above.slope(x, y.col(j), solution_.globals).value - below.slope(x, y.col(j), solution_.globals).value) /
            (2 * step);
    }
    Element element{Eigen::PartialPivLU<Eigen::MatrixXd>(stages), {}, {}};
    element.by_node = element.stages.solve(by_node);
    element.by_global = element.stages.solve(by_global);

    // δy_{i+1} − δy_i − h Σ_j b_j δK_j = continuity defect
    Eigen::MatrixXd left = -Eigen::MatrixXd::Identity(states_, states_);
    Eigen::MatrixXd border = Eigen::MatrixXd::Zero(states_, globals_ + 1);
    for (int j = 0; j < k; ++j) {
        left -= h * rule_.weights(j) * element.by_node.middleRows(j * states_, states_);
        border -= h * rule_.weights(j) * element.by_global.middleRows(j * states_, states_);
    }
    const Eigen::Index row = static_cast<Eigen::Index>(index) * states_;
    for (Eigen::Index a = 0; a < states_; ++a) {
        triplets_.emplace_back(row + a, row + states_ + a, 1.0);
        for (Eigen::Index b = 0; b < states_; ++b) triplets_.emplace_back(row + a, row + b, left(a, b));
        for (Eigen::Index b = 0; b <= globals_; ++b) triplets_.emplace_back(row + a, first_global_ + b, border(a, b));
    }
    elements_.push_back(std::move(element));
}

void LinearisedCollocation::assemble_conditions(const Equations& here, const Equations& above, const Equations& below,
                                                double step) {
    const Eigen::VectorXd first = solution_.nodes.col(0), last = solution_.nodes.rightCols<1>();
    const ConditionValues conditions = here.conditions(first, last, solution_.globals);
    const Eigen::VectorXd by_parameter = (above.conditions(first, last, solution_.globals).value -
                                          below.conditions(first, last, solution_.globals).value) /
                                         (2 * step);
    const Eigen::Index row = first_global_ - states_, last_node = first_global_ - states_;
    for (Eigen::Index a = 0; a < states_ + globals_; ++a) {
        for (Eigen::Index b = 0; b < states_; ++b) {
            triplets_.emplace_back(row + a, b, conditions.by_first(a, b));
            triplets_.emplace_back(row + a, last_node + b, conditions.by_last(a, b));
        }
        for (Eigen::Index b = 0; b < globals_; ++b)
            triplets_.emplace_back(row + a, first_global_ + b, conditions.by_global(a, b));
        triplets_.emplace_back(row + a, first_global_ + globals_, by_parameter(a));
    }
}

void LinearisedCollocation::assemble_branch_condition(const PiecewiseSolution& normal) {
    const Eigen::Index row = unknowns_ - 1;
    for (std::size_t i = 0; i < normal.mesh.size(); ++i) {
        const auto node = static_cast<Eigen::Index>(i);
        for (Eigen::Index a = 0; a < states_; ++a)
            triplets_.emplace_back(
                row, node * states_ + a,
                normal.weight(i) * normal.nodes(a, node) / (problem_.state_scales(a) * problem_.state_scales(a)));
    }
    for (Eigen::Index b = 0; b < globals_; ++b)
        triplets_.emplace_back(row, first_global_ + b,
                               normal.globals(b) / (problem_.global_scales(b) * problem_.global_scales(b)));
    triplets_.emplace_back(row, first_global_ + globals_,
                           normal.parameter / (problem_.parameter_scale * problem_.parameter_scale));
}

PiecewiseSolution LinearisedCollocation::solve(const CollocationDefect& right_hand_side) const {
    const int k = rule_.points;
    Eigen::VectorXd reduced(unknowns_);
    std::vector<Eigen::VectorXd> particular;  // δK for δy_i = 0
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        particular.push_back(elements_[i].stages.solve(right_hand_side.stages[i].reshaped()));
        const auto column = static_cast<Eigen::Index>(i);
        auto segment = reduced.segment(column * states_, states_);
        segment = right_hand_side.continuity.col(column) +
                  solution_.width(i) * (particular.back().reshaped(states_, k) * rule_.weights);
    }
    reduced.segment(first_global_ - states_, states_ + globals_) = right_hand_side.conditions;
    reduced(unknowns_ - 1) = right_hand_side.branch;
    const Eigen::VectorXd unknowns = factors_.solve(reduced);

    PiecewiseSolution change{solution_.mesh, {}, {}, unknowns.segment(first_global_, globals_), 0};
    change.nodes = unknowns.head(first_global_).reshaped(states_, static_cast<Eigen::Index>(solution_.mesh.size()));
    change.parameter = unknowns(unknowns_ - 1);
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        const Eigen::VectorXd slopes = particular[i] +
                                       elements_[i].by_node * change.nodes.col(static_cast<Eigen::Index>(i)) +
                                       elements_[i].by_global * unknowns.tail(globals_ + 1);
        change.slopes.emplace_back(slopes.reshaped(states_, k));
    }
    return change;
}

PiecewiseSolution LinearisedCollocation::tangent() const {
    CollocationDefect unit;
    for (std::size_t i = 0; i < elements_.size(); ++i)
        unit.stages.emplace_back(Eigen::MatrixXd::Zero(states_, rule_.points));
    unit.continuity = Eigen::MatrixXd::Zero(states_, static_cast<Eigen::Index>(elements_.size()));
    unit.conditions = Eigen::VectorXd::Zero(states_ + globals_);
    unit.branch = 1;
    PiecewiseSolution direction = solve(unit);
    direction.scale(1 / std::sqrt(inner_product(direction, direction, problem_)));
    return direction;
}

}  // namespace endoflow::statics
