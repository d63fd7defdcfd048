#pragma once

// From values at quadrature points to coefficients of the basis functions of each element.

#include <array>
#include <cstddef>

namespace endoflow::boundary_integral {

/// Basis values of one point lie side by side, padded with zeros to a vector register.
inline constexpr std::size_t basis_stride = 8;

/// Two tables of basis values, each for two kinds of values at the points. For every element e and function j, with i
/// running over the element's `points` points:
///     sums[k][basis_stride e + j] = Σ_i measure[i] values[k][i] basis[basis_stride i + j],
/// k = 0, 1 by the first basis, k = 2, 3 by the second. Four independent sums keep the multipliers busy.
void point_sums(std::size_t elements, std::size_t points, const double* first_basis, const double* second_basis,
                const double* measure, const std::array<const double*, 4>& values, const std::array<double*, 4>& sums);

}  // namespace endoflow::boundary_integral
