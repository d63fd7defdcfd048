#pragma once

#include <Eigen/Core>
#include <vector>

#include "statics/boundary_value_problem.h"
#include "statics/gauss_rule.h"

namespace endoflow::statics {

/// A collocation solution (or a direction in the space of solutions) on N elements with k Gauss points each.
struct PiecewiseSolution {
    std::vector<double> mesh;             // 0 = x_0 < … < x_N = 1
    Eigen::MatrixXd nodes;                // y(x_i), (n, N + 1)
    std::vector<Eigen::MatrixXd> slopes;  // dy/dx at the Gauss points of each element, N times (n, k)
    Eigen::VectorXd globals;              // (g)
    double parameter = 0;

    [[nodiscard]] std::size_t elements() const { return slopes.size(); }
    [[nodiscard]] double width(std::size_t element) const { return mesh[element + 1] - mesh[element]; }
    /// Weight of a mesh point in the trapezoidal rule.
    [[nodiscard]] double weight(std::size_t point) const;
    /// The element that holds x.
    [[nodiscard]] std::size_t element_of(double x) const;
    /// this += factor · direction; both on the same mesh.
    void add(double factor, const PiecewiseSolution& direction);
    void scale(double factor);
};

/// y(x), (n), error O(h^(k+1)); at the mesh points the superconvergent values.
[[nodiscard]] Eigen::VectorXd evaluate(const PiecewiseSolution& solution, const GaussRule& rule, double x);

/// dy/dx at x, of the element that element_of() gives.
[[nodiscard]] Eigen::VectorXd slope_at(const PiecewiseSolution& solution, const GaussRule& rule, double x);

/// The same functions on another mesh.
[[nodiscard]] PiecewiseSolution interpolate(const PiecewiseSolution& solution, const GaussRule& rule,
                                            const std::vector<double>& mesh);

/// The same functions on another mesh with another number of Gauss points per element.
[[nodiscard]] PiecewiseSolution resample(const PiecewiseSolution& solution, const GaussRule& rule,
                                         const std::vector<double>& mesh, const GaussRule& new_rule);

/// Samples functions given as y(x) and dy/dx(x), (n) each.
[[nodiscard]] PiecewiseSolution sample(const std::vector<double>& mesh, const GaussRule& rule,
                                       const std::function<Eigen::VectorXd(double)>& y,
                                       const std::function<Eigen::VectorXd(double)>& slope,
                                       const Eigen::VectorXd& globals, double parameter);

/// Mesh of `elements` elements on which the local errors ∝ h^(k+1) |y^(k+1)| are equal (as in COLSYS: U. Ascher,
/// J. Christiansen, R. D. Russell, ACM TOMS 7, 209 (1981)), the derivative being estimated from jumps of y^(k).
[[nodiscard]] std::vector<double> equidistributed_mesh(const PiecewiseSolution& solution, const GaussRule& rule,
                                                       const Eigen::VectorXd& state_scales, std::size_t elements);

/// Every element cut in two.
[[nodiscard]] std::vector<double> halved_mesh(const std::vector<double>& mesh);

/// Inner product along a branch: ∫ of the states plus globals plus parameter, all in units of the problem's scales.
[[nodiscard]] double inner_product(const PiecewiseSolution& a, const PiecewiseSolution& b,
                                   const BoundaryValueProblem& problem);

/// Largest entry in units of the scales, slopes left out.
[[nodiscard]] double largest_entry(const PiecewiseSolution& direction, const BoundaryValueProblem& problem);

}  // namespace endoflow::statics
