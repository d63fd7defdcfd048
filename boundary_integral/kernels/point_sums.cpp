#include "boundary_integral/kernels/point_sums.h"

#include "shared/numerics/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

ENDOFLOW_VECTOR_CLONES
void four_sums(std::size_t elements, std::size_t points, const double* __restrict measure, const PointSum* four) {
    const double* __restrict v0 = four[0].values;
    const double* __restrict v1 = four[1].values;
    const double* __restrict v2 = four[2].values;
    const double* __restrict v3 = four[3].values;
    for (std::size_t e = 0; e < elements; ++e) {
        double a[basis_stride] = {}, b[basis_stride] = {}, c[basis_stride] = {}, d[basis_stride] = {};
        for (std::size_t i = e * points; i < (e + 1) * points; ++i) {
            const double w0 = measure[i] * v0[i], w1 = measure[i] * v1[i];
            const double w2 = measure[i] * v2[i], w3 = measure[i] * v3[i];
            const double* b0 = four[0].basis + four[0].width * i;
            const double* b1 = four[1].basis + four[1].width * i;
            const double* b2 = four[2].basis + four[2].width * i;
            const double* b3 = four[3].basis + four[3].width * i;
            for (std::size_t j = 0; j < basis_stride; ++j) a[j] += w0 * b0[j];
            for (std::size_t j = 0; j < basis_stride; ++j) b[j] += w1 * b1[j];
            for (std::size_t j = 0; j < basis_stride; ++j) c[j] += w2 * b2[j];
            for (std::size_t j = 0; j < basis_stride; ++j) d[j] += w3 * b3[j];
        }
        const std::size_t begin = basis_stride * e;
        for (std::size_t j = 0; j < basis_stride; ++j) four[0].sums[begin + j] = a[j];
        for (std::size_t j = 0; j < basis_stride; ++j) four[1].sums[begin + j] = b[j];
        for (std::size_t j = 0; j < basis_stride; ++j) four[2].sums[begin + j] = c[j];
        for (std::size_t j = 0; j < basis_stride; ++j) four[3].sums[begin + j] = d[j];
    }
}

}  // namespace

void point_sums(std::size_t elements, std::size_t points, const double* measure, const std::array<PointSum, 4>& four) {
    four_sums(elements, points, measure, four.data());
}

}  // namespace endoflow::boundary_integral
