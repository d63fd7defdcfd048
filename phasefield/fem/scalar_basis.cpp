#include "phasefield/fem/scalar_basis.h"

#include <deal.II/fe/fe_q.h>

#include "phasefield/fem/small_product.h"

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
    for (const auto shapes : {&ShapeArrays::value, &ShapeArrays::dx, &ShapeArrays::dy, &ShapeArrays::dxx,
                              &ShapeArrays::dxy, &ShapeArrays::dyy})
        for (unsigned int i = 0; i < n_dofs; ++i)
            for (unsigned int q = 0; q < n_points; ++q)
                (by_function.*shapes).push_back((this->*shapes)[q * n_dofs + i]);
}

dealii::Quadrature<2> nodes(unsigned int degree) {
    return dealii::Quadrature<2>(dealii::FE_Q<2>(degree).get_unit_support_points());
}

void evaluate(const ScalarBasis& basis, const CellBox& box, const std::vector<double>& coefficients, Derivatives order,
              ScalarField& field) {
    const auto contract = [&](const std::vector<double>& shapes, double scale, std::vector<double>& out) {
        out.assign(basis.n_points, 0);
        add_transposed_product(coefficients.data(), shapes.data(), basis.n_dofs, 1, basis.n_points, out.data());
        for (double& value : out) value *= scale;
    };
    const ShapeArrays& shapes = basis.by_function;
    contract(shapes.value, 1, field.value);
    contract(shapes.dx, 1 / box.hr, field.r);
    contract(shapes.dy, 1 / box.hz, field.z);
    if (order == Derivatives::first) return;
    contract(shapes.dxx, 1 / (box.hr * box.hr), field.rr);
    contract(shapes.dxy, 1 / (box.hr * box.hz), field.rz);
    contract(shapes.dyy, 1 / (box.hz * box.hz), field.zz);
}

}  // namespace endoflow::phasefield
