#pragma once

// From values at quadrature points to coefficients of the basis functions of each element.

#include <cstddef>

namespace endoflow::boundary_integral {

// Basis values of one point lie side by side, padded with zeros to a vector register.
inline constexpr std::size_t basis_stride = 8;

// For every element e and function j, with i running over the element's `points` points:
//     first_sums[basis_stride e + j]  = sum_i measure[i] first[i] basis[basis_stride i + j],  second_sums likewise.
void point_sums(std::size_t elements, std::size_t points, const double* basis, const double* measure,
                const double* first, const double* second, double* first_sums, double* second_sums);

}  // namespace endoflow::boundary_integral
