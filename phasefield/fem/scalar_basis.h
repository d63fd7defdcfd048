#pragma once

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature.h>

#include <vector>

namespace endoflow::phasefield {

/// Integrals over r and z become those over the body of revolution.
inline constexpr double two_pi = 2 * dealii::numbers::PI;

/// Scalar shape functions and their derivatives.
struct ShapeArrays {
    std::vector<double> value, dx, dy, dxx, dxy, dyy;
};

/// Values and derivatives of the scalar Q_k shape functions at the quadrature points of the unit cell, [q * n_dofs +
/// i], and the same in the other order, [i * n_points + q]. Cells are axis-aligned rectangles, so physical derivatives
/// are these divided by the cell's extents: no mapping is evaluated in the assembly loops.
struct ScalarBasis : ShapeArrays {
    ScalarBasis(unsigned int degree, const dealii::Quadrature<2>& quadrature);

    unsigned int degree, n_dofs, n_points;
    ShapeArrays by_function;
};

/// The nodes of Q_k on the unit cell, in the order of its shape functions.
dealii::Quadrature<2> nodes(unsigned int degree);

/// The rectangle [r0, r0 + hr] × [z0, z0 + hz].
struct CellBox {
    double r0, z0, hr, hz;
};

template <class Cell>
CellBox cell_box(const Cell& cell) {
    const auto& lower = cell->vertex(0);
    const auto& upper = cell->vertex(3);
    return {lower[0], lower[1], upper[0] - lower[0], upper[1] - lower[1]};
}

/// A scalar finite element function at the quadrature points of one cell: value, first and (if asked for) second
/// derivatives.
struct ScalarField {
    std::vector<double> value, r, z, rr, rz, zz;
};

enum class Derivatives { first, second };

/// Evaluates Σ_i coefficients[i] N_i at all quadrature points.
void evaluate(const ScalarBasis& basis, const CellBox& box, const std::vector<double>& coefficients, Derivatives order,
              ScalarField& field);

}  // namespace endoflow::phasefield
