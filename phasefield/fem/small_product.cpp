#include "phasefield/fem/small_product.h"

#include <cstring>

#include "shared/numerics/vector_clones.h"

namespace endoflow::phasefield {

namespace {

/// Rows [0, rows) and columns [0, lanes × count) of C, kept in registers while the sum runs.
template <std::size_t rows, std::size_t lanes, std::size_t count>
[[gnu::always_inline]] inline void add_block(const double* a, const double* b, std::size_t n, std::size_t n_rows,
                                             std::size_t n_columns, double* c) {
    using Lanes [[gnu::vector_size(lanes * sizeof(double))]] = double;
    Lanes sum[rows][count] = {};
    for (std::size_t q = 0; q < n; ++q)
        for (std::size_t k = 0; k < count; ++k) {
            Lanes part;
            std::memcpy(&part, b + q * n_columns + lanes * k, sizeof part);
            for (std::size_t i = 0; i < rows; ++i) sum[i][k] += a[q * n_rows + i] * part;
        }
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < count; ++k) {
            double* out = c + i * n_columns + lanes * k;
            for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] += sum[i][k][lane];
        }
}

/// All rows of columns [0, lanes × count) of C.
template <std::size_t lanes, std::size_t count>
[[gnu::always_inline]] inline void add_columns(const double* a, const double* b, std::size_t n, std::size_t n_rows,
                                               std::size_t n_columns, double* c) {
    constexpr std::size_t rows = 4;
    std::size_t i = 0;
    for (; i + rows <= n_rows; i += rows)
        add_block<rows, lanes, count>(a + i, b, n, n_rows, n_columns, c + i * n_columns);
    for (; i < n_rows; ++i) add_block<1, lanes, count>(a + i, b, n, n_rows, n_columns, c + i * n_columns);
}

}  // namespace

ENDOFLOW_VECTOR_CLONES
void add_transposed_product(const double* a, const double* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            double* c) {
    std::size_t k = 0;  // a bicubic element has 16 shape functions, a biquadratic one 9; 36 Gauss points
    for (; k + 16 <= n_columns; k += 16) add_columns<8, 2>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + 8 <= n_columns; k += 8) add_columns<8, 1>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + 4 <= n_columns; k += 4) add_columns<4, 1>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k < n_columns; ++k)
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t i = 0; i < n_rows; ++i) c[i * n_columns + k] += a[q * n_rows + i] * b[q * n_columns + k];
}

ENDOFLOW_VECTOR_CLONES
void add_scaled_rows(double factor, const double* scale, const double* b, std::size_t n, std::size_t n_columns,
                     double* c) {
    for (std::size_t q = 0; q < n; ++q) {
        const double by = factor * scale[q];
        for (std::size_t k = 0; k < n_columns; ++k) c[q * n_columns + k] += by * b[q * n_columns + k];
    }
}

}  // namespace endoflow::phasefield
