#include "phasefield/layer/boundary_flux.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

#include "phasefield/fem/component_field.h"

namespace endoflow::phasefield {

dealii::Quadrature<2> face_quadrature(unsigned int face, unsigned int n) {
    const dealii::QGauss<1> gauss(n);
    std::vector<dealii::Point<2>> points;
    for (const auto& point : gauss.get_points()) {
        dealii::Point<2> x(point[0], point[0]);
        x[face / 2] = face % 2;
        points.push_back(x);
    }
    return {points, gauss.get_weights()};
}

namespace {

/// What flows through one of the four faces of a cell.
struct Face {
    Face(const Space& space, unsigned int number, unsigned int n, unsigned int velocity_r, unsigned int velocity_z,
         unsigned int level)
        : quadrature(face_quadrature(number, n)),
          normal_velocity(space, number < 2 ? velocity_r : velocity_z, quadrature),
          level_set(space, level, quadrature) {}
    dealii::Quadrature<2> quadrature;
    ComponentField normal_velocity, level_set;
};

}  // namespace

double extracellular_inflow(const Space& space, const Vector& solution, unsigned int velocity_r,
                            unsigned int velocity_z, unsigned int level, const std::function<double(double)>& phi_of) {
    const unsigned int n = *std::max_element(space.degrees.begin(), space.degrees.end()) + 2;
    std::vector<Face> faces;
    for (unsigned int number = 0; number < 4; ++number)
        faces.emplace_back(space, number, n, velocity_r, velocity_z, level);
    double sum = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned() || !cell->at_boundary()) continue;
        const CellBox box = cell_box(cell);
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary() || cell->face(face)->boundary_id() == Boundary::axis) continue;
            auto& [quadrature, velocity_field, level_set] = faces[face];
            const auto &velocity = velocity_field.on(cell, box, solution), &psi = level_set.on(cell, box, solution);
            const double outward = face % 2 == 1 ? 1 : -1, length = face < 2 ? box.hz : box.hr;
            for (unsigned int q = 0; q < n; ++q) {
                const double r = box.r0 + box.hr * quadrature.point(q)[0];
                sum -= two_pi * r * length * quadrature.weight(q) * outward * velocity.value[q] * 0.5 *
                       (1 + phi_of(psi.value[q]));
            }
        }
    }
    return dealii::Utilities::MPI::sum(sum, space.dofs.get_communicator());
}

}  // namespace endoflow::phasefield
