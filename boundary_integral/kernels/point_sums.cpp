#include "boundary_integral/kernels/point_sums.h"

#include "boundary_integral/kernels/vector_clones.h"

namespace endoflow::boundary_integral {

ENDOFLOW_VECTOR_CLONES
void point_sums(std::size_t elements, std::size_t points, const double* __restrict basis,
                const double* __restrict measure, const double* __restrict first, const double* __restrict second,
                double* __restrict first_sums, double* __restrict second_sums) {
    for (std::size_t e = 0; e < elements; ++e) {
        double a[basis_stride] = {};
        double b[basis_stride] = {};
        for (std::size_t i = e * points; i < (e + 1) * points; ++i) {
            const double from_first = measure[i] * first[i];
            const double from_second = measure[i] * second[i];
            for (std::size_t j = 0; j < basis_stride; ++j) a[j] += from_first * basis[basis_stride * i + j];
            for (std::size_t j = 0; j < basis_stride; ++j) b[j] += from_second * basis[basis_stride * i + j];
        }
        for (std::size_t j = 0; j < basis_stride; ++j) first_sums[basis_stride * e + j] = a[j];
        for (std::size_t j = 0; j < basis_stride; ++j) second_sums[basis_stride * e + j] = b[j];
    }
}

}  // namespace endoflow::boundary_integral
