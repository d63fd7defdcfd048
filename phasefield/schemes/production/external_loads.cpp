#include "phasefield/schemes/production/external_loads.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include "phasefield/layer/boundary_flux.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/cell_points.h"

namespace endoflow::phasefield::production {

namespace {

constexpr unsigned int outer_face = 1;  // of a cell, towards larger r

}  // namespace

RimTension::RimTension(const Space& space, const StepNumbers& step)
    : space_(&space),
      step_(&step),
      quadrature_(face_quadrature(outer_face, gauss_points(step.numerics))),
      shapes_(space.degrees[velocity_r], quadrature_),
      psi_(space, distance, quadrature_),
      u_r_(space, velocity_r, quadrature_) {}

template <class Visit>
void RimTension::on_side(const Cell& cell, const Vector& solution, const Visit& visit) {
    const double sigma = step_->loads.rim_tension;
    if (sigma == 0 || !cell->face(outer_face)->at_boundary()) return;
    const CellBox box = cell_box(cell);
    const auto& psi = psi_.on(cell, box, solution);
    for (unsigned int q = 0; q < quadrature_.size(); ++q) {
        const double epsilon = step_->thickness_at(cell->active_cell_index(), box, 1, quadrature_.point(q)[1]).value;
        const double density = delta_Gamma(layer_profile(psi.value[q], epsilon), step_->weight);
        visit(q, quadrature_.weight(q) * box.hz * (box.r0 + box.hr) * sigma * density);
    }
}

void RimTension::add(const Cell& cell, const Vector& solution, dealii::Vector<double>& right_hand_side) {
    const auto& unknowns_of_cell = space_->local[velocity_r];
    on_side(cell, solution, [&](unsigned int q, double force) {
        for (unsigned int i = 0; i < shapes_.n_dofs; ++i)
            right_hand_side(unknowns_of_cell[i]) += force * shapes_.value[q * shapes_.n_dofs + i];
    });
}

double RimTension::power(const Cell& cell, const Vector& solution) {
    double sum = 0;
    const auto& u_r = u_r_.on(cell, cell_box(cell), solution);
    on_side(cell, solution, [&](unsigned int q, double force) { sum += two_pi * force * u_r.value[q]; });
    return sum;
}

double load_power(const StepProblem& problem, const Vector& solution) {
    const Space& space = problem.space;
    const StepNumbers& step = problem.numbers;
    if (step.loads.none()) return 0;
    const dealii::QGauss<2> quadrature(gauss_points(step.numerics));
    double sum = 0;
    for_each_point(space, step, quadrature, {{&space, &solution, {velocity_r, velocity_z, distance, molecule_density}}},
                   [&](const CellPoint& at, const auto& fields) {
                       const Fields<double>& x = fields.front();
                       const PointPast& past = problem.past.points.at(at.cell->active_cell_index())[at.q];
                       const auto layer = layer_profile(x[distance].value, at.thickness.value);
                       const double u_r = x[velocity_r].value, u_z = x[velocity_z].value;
                       const double pushed = -step.loads.pressure * (x[distance].r * u_r + x[distance].z * u_z);
                       const double pulled = past.material_force.z + step.coat_force * x[molecule_density].value;
                       sum += at.measure * (delta_N(layer) * pushed + delta_Gamma(layer, step.weight) *
                                                                          (past.material_force.r * u_r + pulled * u_z));
                   });
    RimTension rim(space, step);
    for_each_cell(space, [&](const Cell& cell, const CellBox& /*box*/) { sum += rim.power(cell, solution); });
    return dealii::Utilities::MPI::sum(sum, space.dofs.get_communicator());
}

}  // namespace endoflow::phasefield::production
