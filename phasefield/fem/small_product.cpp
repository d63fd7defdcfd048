#include "phasefield/fem/small_product.h"

#include <cstring>

#include "shared/numerics/vector_clones.h"

namespace endoflow::phasefield {

namespace {

constexpr std::size_t lanes = 4;
using Lanes [[gnu::vector_size(lanes * sizeof(double))]] = double;

/// Columns [0, lanes × count) of C, kept in registers while the sum runs.
template <std::size_t count>
[[gnu::always_inline]] inline void add_columns(const double* a, const double* b, std::size_t n, std::size_t n_rows,
                                               std::size_t n_columns, double* c) {
    for (std::size_t i = 0; i < n_rows; ++i) {
        Lanes sum[count] = {};
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t k = 0; k < count; ++k) {
                Lanes part;
                std::memcpy(&part, b + q * n_columns + lanes * k, sizeof part);
                sum[k] += a[q * n_rows + i] * part;
            }
        for (std::size_t k = 0; k < count; ++k) {
            double* out = c + i * n_columns + lanes * k;
            for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] += sum[k][lane];
        }
    }
}

}  // namespace

ENDOFLOW_VECTOR_CLONES
void add_transposed_product(const double* a, const double* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            double* c) {
    constexpr std::size_t wide = 4, narrow = 2;  // 36 Gauss points; a bicubic element has 16 shape functions
    std::size_t k = 0;
    for (; k + wide * lanes <= n_columns; k += wide * lanes) add_columns<wide>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + narrow * lanes <= n_columns; k += narrow * lanes)
        add_columns<narrow>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k + lanes <= n_columns; k += lanes) add_columns<1>(a, b + k, n, n_rows, n_columns, c + k);
    for (; k < n_columns; ++k)
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t i = 0; i < n_rows; ++i) c[i * n_columns + k] += a[q * n_rows + i] * b[q * n_columns + k];
}

}  // namespace endoflow::phasefield
