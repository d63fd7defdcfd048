#include "phasefield/evolution/boundary_flux.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

#include "phasefield/discretization/scalar_basis.h"

namespace endoflow::phasefield {

namespace {

constexpr double two_pi = 2 * dealii::numbers::PI;

/// Gauss points on one face of the unit cell, as points of the cell.
dealii::Quadrature<2> on_face(unsigned int face, unsigned int n) {
    const dealii::QGauss<1> gauss(n);
    std::vector<dealii::Point<2>> points;
    for (const auto& point : gauss.get_points()) {
        dealii::Point<2> x(point[0], point[0]);
        x[face / 2] = face % 2;
        points.push_back(x);
    }
    return {points, gauss.get_weights()};
}

}  // namespace

double extracellular_inflow(const Space& space, const Vector& solution, unsigned int velocity_r,
                            unsigned int velocity_z, unsigned int level, const std::function<double(double)>& phi_of) {
    const unsigned int n = *std::max_element(space.degrees.begin(), space.degrees.end()) + 2;
    dealii::Vector<double> values(space.element.n_dofs_per_cell());
    std::vector<double> coefficients;
    ScalarField normal_velocity, psi;
    double sum = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned() || !cell->at_boundary()) continue;
        const CellBox box = cell_box(cell);
        cell->get_dof_values(solution, values);
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary() || cell->face(face)->boundary_id() == Boundary::axis) continue;
            const auto quadrature = on_face(face, n);
            const bool vertical = face < 2;  // its normal is ±e_r
            const unsigned int component = vertical ? velocity_r : velocity_z;
            component_values(space, component, values, coefficients);
            evaluate(ScalarBasis(space.degrees[component], quadrature), box, coefficients, Derivatives::first,
                     normal_velocity);
            component_values(space, level, values, coefficients);
            evaluate(ScalarBasis(space.degrees[level], quadrature), box, coefficients, Derivatives::first, psi);
            const double outward = face % 2 == 1 ? 1 : -1, length = vertical ? box.hz : box.hr;
            for (unsigned int q = 0; q < n; ++q) {
                const double r = box.r0 + box.hr * quadrature.point(q)[0];
                sum -= two_pi * r * length * quadrature.weight(q) * outward * normal_velocity.value[q] * 0.5 *
                       (1 + phi_of(psi.value[q]));
            }
        }
    }
    return dealii::Utilities::MPI::sum(sum, space.dofs.get_communicator());
}

}  // namespace endoflow::phasefield
