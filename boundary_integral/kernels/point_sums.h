#pragma once

// From values at quadrature points to coefficients of the basis functions of each element.

#include <array>
#include <cstddef>

namespace endoflow::boundary_integral {

/// Basis values of one point lie side by side, padded with zeros to a vector register.
inline constexpr std::size_t basis_stride = 8;

/// With i running over the `points` points of element e,
///     sums[basis_stride e + j] = Σ_i measure[i] values[i] basis[width i + j]      for all elements e and functions j.
struct PointSum {
    const double* basis;
    std::size_t width;
    const double* values;
    double* sums;
};

/// Four independent sums keep the multipliers busy; cheapest where the first two and the last two share a basis.
void point_sums(std::size_t elements, std::size_t points, const double* measure, const std::array<PointSum, 4>& four);

}  // namespace endoflow::boundary_integral
