// The blocks of a cell's Jacobian.

#include <deal.II/base/quadrature_lib.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/fem/local_system.h"
#include "phasefield/fem/mesh.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;

TEST_CASE("a form that is linear in a field's derivatives up to the second is its Jacobian times the field",
          "[local]") {
    const auto mesh = coarse_mesh(small_case(), MPI_COMM_SELF);
    Space space(*mesh, {2, 3});
    space.distribute();
    constexpr unsigned int test = 0, trial = 1;
    const dealii::QGauss<2> quadrature(5);
    LocalSystem local(space, quadrature, trial);
    const unsigned int n = space.element.n_dofs_per_cell();
    dealii::Vector<double> values(n), product(n), right_hand_side(n);
    for (unsigned int i = 0; i < n; ++i) values(i) = std::sin(1.0 + 2.0 * i);
    local.start({0.3, 0.2, 1.7, 0.9}, values);

    const ScalarField& field = local.field(trial);
    const std::array<const std::vector<double>*, 6> parts{&field.value, &field.r,  &field.z,
                                                          &field.rr,    &field.rz, &field.zz};
    std::array<Coefficients, 6> weights;
    LocalSystem::Weights addresses{};
    Coefficients form(quadrature.size());
    for (std::size_t op = 0; op < parts.size(); ++op) {
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            weights[op].push_back(std::cos(3.0 * q + static_cast<double>(op)));
            form[q] += weights[op][q] * (*parts[op])[q];
        }
        addresses[op] = &weights[op];
    }
    local.residual(test, Op::dz, form);
    local.jacobian(test, Op::dz, trial, addresses);
    dealii::FullMatrix<double> jacobian(n, n);
    local.write(jacobian, right_hand_side);
    jacobian.vmult(product, values);
    CHECK(right_hand_side.l2_norm() > 1);
    product += right_hand_side;
    CHECK(product.linfty_norm() < 1e-12 * right_hand_side.l2_norm());  // the same sums, in another order
}
