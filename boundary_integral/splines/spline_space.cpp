#include "boundary_integral/splines/spline_space.h"

#include <algorithm>
#include <utility>

namespace endoflow::boundary_integral {

SplineSpace::SplineSpace(int degree, std::vector<double> breakpoints, Parity parity, RightEnd right_end)
    : degree_(degree), parity_(parity), right_end_(right_end), breakpoints_(std::move(breakpoints)) {
    const std::size_t last = breakpoints_.size() - 1;
    const double first_interval = breakpoints_[1] - breakpoints_[0];
    const double beyond = right_end_ == RightEnd::mirrored ? breakpoints_[last] - breakpoints_[last - 1] : 0.0;
    for (int i = degree_; i >= 1; --i) knots_.push_back(-i * first_interval);
    knots_.insert(knots_.end(), breakpoints_.begin(), breakpoints_.end());
    for (int i = 1; i <= degree_; ++i) knots_.push_back(breakpoints_.back() + i * beyond);
    for (Index raw = 0; raw < raw_count(); ++raw) {
        Index folded = 0;
        if (fold(raw, folded) != 0.0) dimension_ = std::max(dimension_, folded + 1);
    }
    for (std::size_t element = 0; element < last; ++element) pieces_.push_back(piece(static_cast<Index>(element)));
}

/// Raw function i is mirrored about the axis into p - 1 - i, and likewise about a mirrored end.
double SplineSpace::fold(Index raw, Index& folded) const {
    const double sign_of_mirror = parity_ == Parity::odd ? -1.0 : 1.0;
    const bool odd_degree = degree_ % 2 == 1;
    const Index centre = degree_ / 2;  // p odd: index centred on the axis; p even: first one right of it
    double sign = 1.0;
    const auto mirror = [&](Index image, bool outside) {
        if (raw == image && parity_ == Parity::odd) sign = 0.0;
        if (outside) {
            raw = image;
            sign *= sign_of_mirror;
        }
    };
    mirror(mirror_about_start(raw), raw < mirror_about_start(raw));
    if (right_end_ == RightEnd::mirrored) mirror(mirror_about_end(raw), raw > mirror_about_end(raw));
    folded = sign == 0.0 ? 0 : raw - centre - ((odd_degree && parity_ == Parity::odd) ? 1 : 0);
    return sign;
}

Index SplineSpace::element_of(double xi) const {
    const auto upper = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), xi);
    const Index element = static_cast<Index>(upper - breakpoints_.begin()) - 1;
    return std::clamp<Index>(element, 0, static_cast<Index>(breakpoints_.size()) - 2);
}

/// Algorithm A2.3 of Piegl & Tiller, "The NURBS Book".
void SplineSpace::raw_basis(double xi, Index element, std::array<std::array<double, 6>, 6>& values) const {
    const Index span = element + degree_;
    const int p = degree_;
    std::array<std::array<double, 6>, 6> ndu{};
    std::array<double, 6> left{};
    std::array<double, 6> right{};
    ndu[0][0] = 1.0;
    for (int j = 1; j <= p; ++j) {
        left[at(j)] = xi - knots_[at(span + 1 - j)];
        right[at(j)] = knots_[at(span + j)] - xi;
        double saved = 0.0;
        for (int r = 0; r < j; ++r) {
            ndu[at(j)][at(r)] = right[at(r + 1)] + left[at(j - r)];
            const double term = ndu[at(r)][at(j - 1)] / ndu[at(j)][at(r)];
            ndu[at(r)][at(j)] = saved + right[at(r + 1)] * term;
            saved = left[at(j - r)] * term;
        }
        ndu[at(j)][at(j)] = saved;
    }
    for (int j = 0; j <= p; ++j) values[0][at(j)] = ndu[at(j)][at(p)];
    for (int r = 0; r <= p; ++r) {
        std::array<std::array<double, 6>, 2> a{};
        std::size_t s1 = 0;
        std::size_t s2 = 1;
        a[0][0] = 1.0;
        for (int k = 1; k <= p; ++k) {
            double d = 0.0;
            const int rk = r - k;
            const int pk = p - k;
            if (r >= k) {
                a[s2][0] = a[s1][0] / ndu[at(pk + 1)][at(rk)];
                d = a[s2][0] * ndu[at(rk)][at(pk)];
            }
            const int j1 = rk >= -1 ? 1 : -rk;
            const int j2 = (r - 1 <= pk) ? k - 1 : p - r;
            for (int j = j1; j <= j2; ++j) {
                a[s2][at(j)] = (a[s1][at(j)] - a[s1][at(j - 1)]) / ndu[at(pk + 1)][at(rk + j)];
                d += a[s2][at(j)] * ndu[at(rk + j)][at(pk)];
            }
            if (r <= pk) {
                a[s2][at(k)] = -a[s1][at(k - 1)] / ndu[at(pk + 1)][at(r)];
                d += a[s2][at(k)] * ndu[at(r)][at(pk)];
            }
            values[at(k)][at(r)] = d;
            std::swap(s1, s2);
        }
    }
    double factor = p;
    for (int k = 1; k <= p; ++k) {
        for (int j = 0; j <= p; ++j) values[at(k)][at(j)] *= factor;
        factor *= (p - k);
    }
}

SplineSpace::Piece SplineSpace::piece(Index element) const {
    const bool last = at(element) + 2 == breakpoints_.size();
    Piece result{breakpoints_[at(last ? element + 1 : element)], {}, {}};
    std::array<std::array<double, 6>, 6> raw{};
    raw_basis(result.origin, element, raw);
    for (int j = 0; j <= degree_; ++j) {
        Index folded = 0;
        const double sign = fold(element + j, folded);
        result.index[at(j)] = folded;
        double factorial = 1.0;
        for (int k = 0; k <= degree_; ++k) {
            if (k > 0) factorial *= k;
            result.coefficient[at(k)][at(j)] = sign * raw[at(k)][at(j)] / factorial;
        }
    }
    return result;
}

BasisRow SplineSpace::basis(double xi, Index element) const {
    const Piece& piece = pieces_[at(element < 0 ? element_of(xi) : element)];
    const double x = xi - piece.origin;
    BasisRow row;
    row.count = degree_ + 1;
    row.index = piece.index;
    auto& [value, first, second] = row.value;
    for (std::size_t j = 0; j < 6; ++j) {
        double f = piece.coefficient[5][j], f1 = 0.0, half_f2 = 0.0;
        for (std::size_t k = 5; k-- > 0;) {
            half_f2 = half_f2 * x + f1;
            f1 = f1 * x + f;
            f = f * x + piece.coefficient[k][j];
        }
        value[j] = f;
        first[j] = f1;
        second[j] = 2.0 * half_f2;
    }
    return row;
}

std::array<double, 6> SplineSpace::taylor(const Eigen::VectorXd& coefficients, double xi, Index element) const {
    const Piece& piece = pieces_[at(element)];
    std::array<double, 6> polynomial{};
    for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t j = 0; j < 6; ++j) polynomial[k] += piece.coefficient[k][j] * coefficients[piece.index[j]];
    }
    // Horner's scheme again and again shifts the polynomial to ξ.
    const double x = xi - piece.origin;
    double factorial = 1.0;
    for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t j = 5; j-- > k;) polynomial[j] += x * polynomial[j + 1];
        if (k > 0) factorial *= static_cast<double>(k);
        polynomial[k] *= factorial;
    }
    return polynomial;
}

std::vector<double> SplineSpace::greville_points() const {
    std::vector<double> points(at(dimension_), 0.0);
    for (Index raw = 0; raw < raw_count(); ++raw) {
        Index folded = 0;
        const bool image =
            raw < mirror_about_start(raw) || (right_end_ == RightEnd::mirrored && raw > mirror_about_end(raw));
        if (image || fold(raw, folded) == 0.0) continue;
        double sum = 0.0;
        for (int k = 1; k <= degree_; ++k) sum += knots_[at(raw + k)];
        points[at(folded)] = std::clamp(sum / degree_, 0.0, 1.0);
    }
    return points;
}

std::vector<double> uniform_breakpoints(Index elements) {
    std::vector<double> points;
    for (Index i = 0; i <= elements; ++i) points.push_back(static_cast<double>(i) / static_cast<double>(elements));
    return points;
}

Eigen::MatrixXd collocation_matrix(const SplineSpace& space, const std::vector<double>& points, int derivative) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(static_cast<Index>(points.size()), space.dimension());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const BasisRow row = space.basis(points[i]);
        for (int j = 0; j < row.count; ++j) {
            matrix(static_cast<Index>(i), row.index[at(j)]) += row.value[at(derivative)][at(j)];
        }
    }
    return matrix;
}

}  // namespace endoflow::boundary_integral
