#pragma once

#include <cstddef>

namespace endoflow::phasefield {

/// C += Aᵀ B, row by row in memory: A is n × n_rows, B n × n_columns, C n_rows × n_columns. Made for the few dozen rows
/// and columns of one cell's blocks, where calling BLAS costs more than the product.
void add_transposed_product(const double* a, const double* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            double* c);
void add_transposed_product(const float* a, const float* b, std::size_t n, std::size_t n_rows, std::size_t n_columns,
                            float* c);

/// Adds to each row q of C that of B times `factor` and scale[q]; both n × n_columns.
void add_scaled_rows(double factor, const double* scale, const double* b, std::size_t n, std::size_t n_columns,
                     double* c);
void add_scaled_rows(float factor, const float* scale, const float* b, std::size_t n, std::size_t n_columns, float* c);

}  // namespace endoflow::phasefield
