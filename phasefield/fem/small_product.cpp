#include "phasefield/fem/small_product.h"

#include <cstring>

#include "shared/numerics/vector_clones.h"

namespace endoflow::phasefield {

namespace {

/// Rows [0, rows) and columns [0, lanes × count) of C, kept in registers while the sum runs.
template <std::size_t rows, std::size_t lanes, std::size_t count, class Real>
[[gnu::always_inline]] inline void add_block(const Real* a, const Real* b, std::size_t n, std::size_t n_rows,
                                             std::size_t n_columns, Real* c) {
    using Lanes [[gnu::vector_size(lanes * sizeof(Real))]] = Real;
    Lanes sum[rows][count] = {};
    for (std::size_t q = 0; q < n; ++q)
        for (std::size_t k = 0; k < count; ++k) {
            Lanes part;
            std::memcpy(&part, b + q * n_columns + lanes * k, sizeof part);
            for (std::size_t i = 0; i < rows; ++i) sum[i][k] += a[q * n_rows + i] * part;
        }
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < count; ++k) {
            Real* out = c + i * n_columns + lanes * k;
            for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] += sum[i][k][lane];
        }
}

/// All rows of columns [0, lanes × count) of C.
template <std::size_t lanes, std::size_t count, class Real>
[[gnu::always_inline]] inline void add_columns(const Real* a, const Real* b, std::size_t n, std::size_t n_rows,
                                               std::size_t n_columns, Real* c) {
    constexpr std::size_t rows = 8 / count;  // sums that do not wait for each other
    std::size_t i = 0;
    for (; i + rows <= n_rows; i += rows)
        add_block<rows, lanes, count>(a + i, b, n, n_rows, n_columns, c + i * n_columns);
    for (; i < n_rows; ++i) add_block<1, lanes, count>(a + i, b, n, n_rows, n_columns, c + i * n_columns);
}

template <class Real>
[[gnu::always_inline]] inline void transposed_product(const Real* a, const Real* b, std::size_t n, std::size_t n_rows,
                                                      std::size_t n_columns, Real* c) {
    constexpr std::size_t whole = 64 / sizeof(Real), half = whole / 2;
    std::size_t k = 0;  // a bicubic element has 16 shape functions, a biquadratic one 9; 36 Gauss points
    for (; k + 2 * whole <= n_columns; k += 2 * whole) add_columns<whole, 2>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + whole <= n_columns; k += whole) add_columns<whole, 1>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + half <= n_columns; k += half) add_columns<half, 1>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k < n_columns; ++k)
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t i = 0; i < n_rows; ++i) c[i * n_columns + k] += a[q * n_rows + i] * b[q * n_columns + k];
}

template <class Real>
[[gnu::always_inline]] inline void scaled_rows(Real factor, const Real* scale, const Real* b, std::size_t n,
                                               std::size_t n_columns, Real* c) {
    for (std::size_t q = 0; q < n; ++q) {
        const Real by = factor * scale[q];
        for (std::size_t k = 0; k < n_columns; ++k) c[q * n_columns + k] += by * b[q * n_columns + k];
    }
}

}  // namespace

ENDOFLOW_VECTOR_CLONES
void add_transposed_product(const double* a, const double* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            double* c) {
    transposed_product(a, b, n, n_rows, n_columns, c);
}
ENDOFLOW_VECTOR_CLONES
void add_transposed_product(const float* a, const float* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            float* c) {
    transposed_product(a, b, n, n_rows, n_columns, c);
}

ENDOFLOW_VECTOR_CLONES
void add_scaled_rows(double factor, const double* scale, const double* b, std::size_t n, std::size_t n_columns,
                     double* c) {
    scaled_rows(factor, scale, b, n, n_columns, c);
}
ENDOFLOW_VECTOR_CLONES
void add_scaled_rows(float factor, const float* scale, const float* b, std::size_t n, std::size_t n_columns, float* c) {
    scaled_rows(factor, scale, b, n, n_columns, c);
}

}  // namespace endoflow::phasefield
