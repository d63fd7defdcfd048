#include "boundary_integral/kernels/point_sums.h"

#include "shared/numerics/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

/// The basis values of one point, or as many sums; anywhere in memory.
using Lanes [[gnu::vector_size(basis_stride * sizeof(double)), gnu::aligned(alignof(double)), gnu::may_alias]] = double;

ENDOFLOW_VECTOR_CLONES
void four_sums(std::size_t elements, std::size_t points, const double* __restrict measure, const PointSum* four) {
    const auto [b0, width0, v0, sums0] = four[0];
    const auto [b1, width1, v1, sums1] = four[1];
    const auto [b2, width2, v2, sums2] = four[2];
    const auto [b3, width3, v3, sums3] = four[3];
    const auto basis = [](const double* begin) -> const Lanes& { return *reinterpret_cast<const Lanes*>(begin); };
    const auto sums = [](double* begin) -> Lanes& { return *reinterpret_cast<Lanes*>(begin); };
    for (std::size_t e = 0; e < elements; ++e) {
        Lanes a{}, b{}, c{}, d{};
        for (std::size_t i = e * points; i < (e + 1) * points; ++i) {
            a += measure[i] * v0[i] * basis(b0 + width0 * i);
            b += measure[i] * v1[i] * basis(b1 + width1 * i);
            c += measure[i] * v2[i] * basis(b2 + width2 * i);
            d += measure[i] * v3[i] * basis(b3 + width3 * i);
        }
        sums(sums0 + basis_stride * e) = a;
        sums(sums1 + basis_stride * e) = b;
        sums(sums2 + basis_stride * e) = c;
        sums(sums3 + basis_stride * e) = d;
    }
}

}  // namespace

void point_sums(std::size_t elements, std::size_t points, const double* measure, const std::array<PointSum, 4>& four) {
    four_sums(elements, points, measure, four.data());
}

}  // namespace endoflow::boundary_integral
