#include "phasefield/fem/scalar_basis.h"

#include <deal.II/fe/fe_q.h>

#include <array>
#include <cstddef>

namespace endoflow::phasefield {

ScalarBasis::ScalarBasis(unsigned int degree_, const dealii::Quadrature<2>& quadrature)
    : degree(degree_), n_dofs((degree_ + 1) * (degree_ + 1)), n_points(quadrature.size()) {
    const dealii::FE_Q<2> element(degree);
    for (unsigned int q = 0; q < n_points; ++q)
        for (unsigned int i = 0; i < n_dofs; ++i) {
            const auto gradient = element.shape_grad(i, quadrature.point(q));
            const auto hessian = element.shape_grad_grad(i, quadrature.point(q));
            value.push_back(element.shape_value(i, quadrature.point(q)));
            dx.push_back(gradient[0]);
            dy.push_back(gradient[1]);
            dxx.push_back(hessian[0][0]);
            dxy.push_back(hessian[0][1]);
            dyy.push_back(hessian[1][1]);
        }
}

dealii::Quadrature<2> nodes(unsigned int degree) {
    return dealii::Quadrature<2>(dealii::FE_Q<2>(degree).get_unit_support_points());
}

namespace {

/// out[q] = scale Σ_i shapes[q, i] coefficients[i] of `count` points: as many sums at a time, for each addition waits
/// for the one before it.
template <std::size_t count>
void contract_points(const double* shapes, const std::vector<double>& coefficients, std::size_t n_dofs, double scale,
                     double* out) {
    std::array<double, count> sum{};
    for (std::size_t i = 0; i < n_dofs; ++i)
        for (std::size_t q = 0; q < count; ++q) sum[q] += shapes[q * n_dofs + i] * coefficients[i];
    for (std::size_t q = 0; q < count; ++q) out[q] = scale * sum[q];
}

void contract(const ScalarBasis& basis, const std::vector<double>& shapes, const std::vector<double>& coefficients,
              double scale, std::vector<double>& out) {
    constexpr std::size_t together = 6;  // Gauss points of one row of scheme `production`
    out.resize(basis.n_points);
    std::size_t q = 0;
    for (; q + together <= basis.n_points; q += together)
        contract_points<together>(&shapes[q * basis.n_dofs], coefficients, basis.n_dofs, scale, &out[q]);
    for (; q < basis.n_points; ++q)
        contract_points<1>(&shapes[q * basis.n_dofs], coefficients, basis.n_dofs, scale, &out[q]);
}

}  // namespace

void evaluate(const ScalarBasis& basis, const CellBox& box, const std::vector<double>& coefficients, Derivatives order,
              ScalarField& field) {
    contract(basis, basis.value, coefficients, 1, field.value);
    contract(basis, basis.dx, coefficients, 1 / box.hr, field.r);
    contract(basis, basis.dy, coefficients, 1 / box.hz, field.z);
    if (order == Derivatives::first) return;
    contract(basis, basis.dxx, coefficients, 1 / (box.hr * box.hr), field.rr);
    contract(basis, basis.dxy, coefficients, 1 / (box.hr * box.hz), field.rz);
    contract(basis, basis.dyy, coefficients, 1 / (box.hz * box.hz), field.zz);
}

}  // namespace endoflow::phasefield
