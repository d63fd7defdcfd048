#include "boundary_integral/kernels/point_sums.h"

#include "shared/numerics/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

ENDOFLOW_VECTOR_CLONES
void four_sums(std::size_t elements, std::size_t points, const double* __restrict first_basis,
               const double* __restrict second_basis, const double* __restrict measure, const double* __restrict v0,
               const double* __restrict v1, const double* __restrict v2, const double* __restrict v3,
               double* __restrict s0, double* __restrict s1, double* __restrict s2, double* __restrict s3) {
    for (std::size_t e = 0; e < elements; ++e) {
        double a[basis_stride] = {}, b[basis_stride] = {}, c[basis_stride] = {}, d[basis_stride] = {};
        for (std::size_t i = e * points; i < (e + 1) * points; ++i) {
            const double w0 = measure[i] * v0[i], w1 = measure[i] * v1[i];
            const double w2 = measure[i] * v2[i], w3 = measure[i] * v3[i];
            const double* first = first_basis + basis_stride * i;
            const double* second = second_basis + basis_stride * i;
            for (std::size_t j = 0; j < basis_stride; ++j) a[j] += w0 * first[j];
            for (std::size_t j = 0; j < basis_stride; ++j) b[j] += w1 * first[j];
            for (std::size_t j = 0; j < basis_stride; ++j) c[j] += w2 * second[j];
            for (std::size_t j = 0; j < basis_stride; ++j) d[j] += w3 * second[j];
        }
        const std::size_t begin = basis_stride * e;
        for (std::size_t j = 0; j < basis_stride; ++j) s0[begin + j] = a[j];
        for (std::size_t j = 0; j < basis_stride; ++j) s1[begin + j] = b[j];
        for (std::size_t j = 0; j < basis_stride; ++j) s2[begin + j] = c[j];
        for (std::size_t j = 0; j < basis_stride; ++j) s3[begin + j] = d[j];
    }
}

}  // namespace

void point_sums(std::size_t elements, std::size_t points, const double* first_basis, const double* second_basis,
                const double* measure, const std::array<const double*, 4>& values, const std::array<double*, 4>& sums) {
    four_sums(elements, points, first_basis, second_basis, measure, values[0], values[1], values[2], values[3], sums[0],
              sums[1], sums[2], sums[3]);
}

}  // namespace endoflow::boundary_integral
