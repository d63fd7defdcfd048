#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "phasefield/fem/scalar_basis.h"
#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// A shape function or its derivative, as it enters a weak form; second ones for trial functions alone.
enum class Op : unsigned int { value = 0, dr = 1, dz = 2, drr = 3, drz = 4, dzz = 5 };
inline constexpr std::array all_operations{Op::value, Op::dr, Op::dz, Op::drr, Op::drz, Op::dzz};

/// One coefficient per quadrature point.
using Coefficients = std::vector<double>;

/// The residual R and Jacobian J of a weak form on one cell, component by component.
///
/// The weak forms are written as sums of
///     residual(I, A, w):            R_I[i]    += Σ_q w_q A N_i(q)
///     jacobian(I, A, K, B, w):      J_IK[i,k] += Σ_q w_q A N_i(q) B N_k(q)
///     linear(I, A, K, B, w):        both, for a term linear in component K of the present iterate
/// where I is the test function's component, A ∈ {N, ∂N/∂r, ∂N/∂z}, B one of these or a second derivative, and w_q
/// contains the measure. J and its weights are of Real: single precision where they are for factors.
template <class Real>
class BasicLocalSystem {
  public:
    /// `twice`: the component whose second derivatives are evaluated, too.
    BasicLocalSystem(const Space& space, const dealii::Quadrature<2>& quadrature,
                     std::optional<unsigned int> twice = {});

    /// Starts a cell: zero residual and Jacobian, and the iterate's values at the quadrature points.
    void start(const CellBox& box, const dealii::Vector<double>& iterate);

    void residual(unsigned int test, Op test_op, const Coefficients& weight);
    void jacobian(unsigned int test, Op test_op, unsigned int trial, Op trial_op, const std::vector<Real>& weight);
    /// Weights of all B in the order of Op; nullptr where there is none.
    using Weights = std::array<const std::vector<Real>*, all_operations.size()>;
    /// The sum over them.
    void jacobian(unsigned int test, Op test_op, unsigned int trial, const Weights& weights);
    void linear(unsigned int test, Op test_op, unsigned int trial, Op trial_op, const std::vector<Real>& weight);

    /// The present iterate's component (first derivatives, of one component second ones).
    [[nodiscard]] const ScalarField& field(unsigned int component) const { return fields_[component]; }
    [[nodiscard]] const Coefficients& field(unsigned int component, Op op) const;
    [[nodiscard]] const ScalarBasis& basis(unsigned int component) const { return *bases_[component]; }
    [[nodiscard]] const CellBox& box() const { return box_; }

    /// Copy J and −R into the cell numbering of the space.
    void write(dealii::FullMatrix<double>& jacobian, dealii::Vector<double>& right_hand_side) const {
        write_jacobian(jacobian);
        write_residual(right_hand_side);
    }
    void write_jacobian(dealii::FullMatrix<double>& jacobian) const;
    void write_residual(dealii::Vector<double>& right_hand_side) const;

  private:
    [[nodiscard]] const std::vector<Real>& shapes(unsigned int component, Op op) const;
    [[nodiscard]] double scale(Op op) const;

    const Space* space_;
    std::optional<unsigned int> twice_;
    unsigned int n_components_;
    std::vector<std::shared_ptr<const ScalarBasis>> bases_;
    /// Shape functions as they enter J, in the order of Op.
    std::vector<std::array<std::vector<Real>, all_operations.size()>> shapes_;
    std::vector<ScalarField> fields_;
    std::vector<std::vector<double>> residuals_;
    std::vector<std::vector<Real>> blocks_;  // [test * n_components + trial][i * n_trial + k]
    std::vector<char> used_;
    CellBox box_{};
    Coefficients product_, scaled_;
    std::vector<Real> columns_;
    std::vector<double> coefficients_;
};

using LocalSystem = BasicLocalSystem<double>;

}  // namespace endoflow::phasefield
