#pragma once

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <vector>

#include "statics/piecewise_solution.h"

namespace endoflow::statics {

/// The scalar equation that completes the collocation equations when the parameter is an unknown too:
/// inner_product(normal, solution − origin) = distance.
struct BranchCondition {
    PiecewiseSolution normal;
    PiecewiseSolution origin;
    double distance = 0;
};

/// How far a solution is from satisfying the equations; the signs are those of a right-hand side for Newton's method.
struct CollocationDefect {
    std::vector<Eigen::MatrixXd> stages;  // f(x_j, y_j) − K_j, N times (n, k)
    Eigen::MatrixXd continuity;           // y_i + h Σ b_j K_j − y_{i+1}, (n, N)
    Eigen::VectorXd conditions;           // (n + g)
    double branch = 0;
};

[[nodiscard]] CollocationDefect defect(const BoundaryValueProblem& problem, const GaussRule& rule,
                                       const PiecewiseSolution& solution, const BranchCondition& condition);

/// The collocation equations linearised about a solution. The slopes are eliminated element by element, which leaves
/// a sparse system for the node values, the globals and the parameter.
class LinearisedCollocation {
  public:
    LinearisedCollocation(const BoundaryValueProblem& problem, const GaussRule& rule, const PiecewiseSolution& solution,
                          const BranchCondition& condition);

    /// False when the system is singular to round-off or holds numbers that are not finite.
    [[nodiscard]] bool usable() const { return usable_; }

    /// The change of the solution that removes the defect to first order.
    [[nodiscard]] PiecewiseSolution solve(const CollocationDefect& right_hand_side) const;

    /// The direction along the branch, of length 1, with a positive component along the condition's normal.
    [[nodiscard]] PiecewiseSolution tangent() const;

  private:
    struct Element {
        Eigen::PartialPivLU<Eigen::MatrixXd> stages;  // (I − h J A), (n k, n k)
        Eigen::MatrixXd by_node;                      // δK by δy_i, (n k, n)
        Eigen::MatrixXd by_global;                    // δK by (δglobals, δparameter), (n k, g + 1)
    };

    void assemble_element(const Equations& here, const Equations& above, const Equations& below, double step,
                          std::size_t index);
    void assemble_conditions(const Equations& here, const Equations& above, const Equations& below, double step);
    void assemble_branch_condition(const PiecewiseSolution& normal);

    const BoundaryValueProblem& problem_;
    const GaussRule& rule_;
    PiecewiseSolution solution_;
    Eigen::Index states_, globals_, first_global_, unknowns_;
    std::vector<Element> elements_;
    std::vector<Eigen::Triplet<double>> triplets_;
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
    bool usable_ = true;
};

}  // namespace endoflow::statics
