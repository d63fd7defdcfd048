#pragma once

// B-splines on [0, 1] that continue smoothly through the axis at 0: only combinations with the given parity are kept.

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "shared/geometry/meridian.h"

namespace endoflow::boundary_integral {

using Index = Eigen::Index;

/// An index of Eigen's as one of the standard library's.
[[nodiscard]] constexpr std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

enum class RightEnd { free, mirrored };  // at ξ = 1: multiple knot, or the same parity as at 0

/// Values of the (at most six) functions of a space that do not vanish at one point. An index may appear twice (a
/// function and its mirror image): contributions add. Beyond `count` values are 0.
struct BasisRow {
    static constexpr int capacity = 6;
    int count = 0;
    std::array<Index, capacity> index{};
    std::array<std::array<double, capacity>, 3> value{};  // value[k][j]: k-th derivative of function j

    template <class Coefficients>
    [[nodiscard]] double evaluate(const Coefficients& coefficients, int derivative = 0) const {
        const auto& values = value[static_cast<std::size_t>(derivative)];
        double sum = 0.0;
        for (std::size_t j = 0; j < capacity; ++j) sum += values[j] * coefficients[index[j]];
        return sum;
    }
};

/// Splines of degree p ≤ 5 on the increasing breakpoints 0 = b_0 < ... < b_n = 1, of maximal smoothness inside, with
/// the stated parity about 0 and, at 1, a (p+1)-fold knot or the same parity. p breakpoint intervals beside a mirror
/// must be equally long. Dimension (n intervals), right end free: p odd: n + (p+1)/2 even or n + (p-1)/2 odd functions;
/// p even: n + p/2. Right end mirrored: p odd: n + 1 even or n - 1 odd functions; p even: n.
class SplineSpace {
  public:
    SplineSpace(int degree, std::vector<double> breakpoints, Parity parity, RightEnd right_end = RightEnd::free);

    [[nodiscard]] Index dimension() const { return dimension_; }
    [[nodiscard]] int degree() const { return degree_; }
    [[nodiscard]] const std::vector<double>& breakpoints() const { return breakpoints_; }

    /// Basis at ξ in [0, 1] with the first two derivatives. `element` picks the polynomial piece (for one-sided values
    /// at breakpoints); -1 finds it.
    [[nodiscard]] BasisRow basis(double xi, Index element = -1) const;
    [[nodiscard]] Index element_of(double xi) const;

    /// Greville abscissae, one per function, increasing; the first is 0 for odd degree and even parity.
    [[nodiscard]] std::vector<double> greville_points() const;

    /// All polynomial derivatives 0..degree of the spline with these coefficients, at ξ in the given element.
    [[nodiscard]] std::array<double, 6> taylor(const Eigen::VectorXd& coefficients, double xi, Index element) const;

  private:
    int degree_;
    Parity parity_;
    RightEnd right_end_;
    std::vector<double> breakpoints_;
    std::vector<double> knots_;
    Index dimension_ = 0;

    /// The polynomials of one interval: the functions that do not vanish there, and their derivatives over k!, k = 0 …
    /// degree, at its left end, of the last interval at its right one: conditions at 0 and 1 hold to the last bit.
    struct Piece {
        double origin;
        std::array<Index, 6> index;
        std::array<std::array<double, 6>, 6> coefficient;  // coefficient[k][j]; zeros beyond the degree
    };
    std::vector<Piece> pieces_;

    [[nodiscard]] Index raw_count() const { return static_cast<Index>(knots_.size()) - degree_ - 1; }
    [[nodiscard]] Index mirror_about_start(Index raw) const { return degree_ - 1 - raw; }
    [[nodiscard]] Index mirror_about_end(Index raw) const { return 2 * raw_count() - 1 - degree_ - raw; }
    [[nodiscard]] double fold(Index raw, Index& folded) const;  // sign (or 0) and folded index of a raw B-spline
    [[nodiscard]] Piece piece(Index element) const;
    /// Raw functions first..first+degree on the knot span, all derivatives
    void raw_basis(double xi, Index element, std::array<std::array<double, 6>, 6>& values) const;
};

[[nodiscard]] std::vector<double> uniform_breakpoints(Index elements);

/// Values (derivative k) of all functions at many points: points x dimension, dense.
[[nodiscard]] Eigen::MatrixXd collocation_matrix(const SplineSpace& space, const std::vector<double>& points,
                                                 int derivative = 0);

}  // namespace endoflow::boundary_integral
