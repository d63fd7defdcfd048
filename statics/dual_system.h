#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "shared/numerics/forward.h"
#include "statics/boundary_value_problem.h"

namespace endoflow::statics {

// A first-order system written in dual numbers: what turns its residuals into values with derivatives. Variable i is
// state i; the globals follow the states. N is at least the number of both.

template <std::size_t N>
std::array<Dual<N>, N> dual_unknowns(const Eigen::VectorXd& states, const Eigen::VectorXd& globals) {
    std::array<Dual<N>, N> unknowns{};
    std::size_t next = 0;
    for (const double value : states) {
        unknowns[next] = Dual<N>::variable(value, next);
        ++next;
    }
    for (const double value : globals) {
        unknowns[next] = Dual<N>::variable(value, next);
        ++next;
    }
    return unknowns;
}

/// slopes[i] = dy_i/dx for the states.
template <std::size_t N>
SlopeValues slope_values(std::span<const Dual<N>> slopes, Eigen::Index states, Eigen::Index globals) {
    SlopeValues result{Eigen::VectorXd(states), Eigen::MatrixXd(states, states), Eigen::MatrixXd(states, globals)};
    for (Eigen::Index i = 0; i < states; ++i) {
        const Dual<N>& slope = slopes[static_cast<std::size_t>(i)];
        result.value(i) = slope.value;
        for (Eigen::Index j = 0; j < states; ++j) result.by_state(i, j) = slope.partial[static_cast<std::size_t>(j)];
        for (Eigen::Index j = 0; j < globals; ++j)
            result.by_global(i, j) = slope.partial[static_cast<std::size_t>(states + j)];
    }
    return result;
}

/// Collects conditions with their derivatives by the states at one end and by the globals.
template <std::size_t N>
class ConditionList {
  public:
    ConditionList(Eigen::Index states, Eigen::Index globals)
        : values_{Eigen::VectorXd(states + globals), Eigen::MatrixXd::Zero(states + globals, states),
                  Eigen::MatrixXd::Zero(states + globals, states), Eigen::MatrixXd::Zero(states + globals, globals)} {}

    void at_first(const Dual<N>& residual) { add(values_.by_first, residual); }
    void at_last(const Dual<N>& residual) { add(values_.by_last, residual); }
    [[nodiscard]] const ConditionValues& values() const { return values_; }

  private:
    ConditionValues values_;
    Eigen::Index next_ = 0;

    void add(Eigen::MatrixXd& by_end, const Dual<N>& residual) {
        values_.value(next_) = residual.value;
        const Eigen::Index states = by_end.cols();
        for (Eigen::Index j = 0; j < states; ++j) by_end(next_, j) = residual.partial[static_cast<std::size_t>(j)];
        for (Eigen::Index j = 0; j < values_.by_global.cols(); ++j)
            values_.by_global(next_, j) = residual.partial[static_cast<std::size_t>(states + j)];
        ++next_;
    }
};

}  // namespace endoflow::statics
