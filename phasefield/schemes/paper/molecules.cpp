#include <deal.II/base/quadrature_lib.h>

#include "phasefield/fem/same_cell.h"
#include "phasefield/schemes/paper/conserved_terms.h"
#include "phasefield/schemes/paper/surface_transport.h"
#include "shared/model/double_well.h"

namespace endoflow::phasefield::paper {

namespace {

/// (41):  |∇φ| μ + ε_c ∇·(|∇φ| ∇c) − |∇φ| W'(c)/ε_c = 0, W' linearised about the iterate. ε_c is the molecules' own
/// width.
void add_chemical_potential(const std::vector<LayerPoint>& points, double width, LocalSystem& local) {
    const auto& c = local.field(concentration).value;
    local.linear(potential, Op::value, potential, Op::value,
                 at_layer_points(points, [](const auto& p, std::size_t) { return p.measure * p.weight; }));
    add_layer_diffusion(points, -width, potential, concentration, local);
    local.residual(potential, Op::value, at_layer_points(points, [&](const auto& p, std::size_t q) {
                       return -p.measure * p.weight / width * double_well(c[q]).first;
                   }));
    local.jacobian(potential, Op::value, concentration, Op::value,
                   at_layer_points(points, [&](const auto& p, std::size_t q) {
                       return -p.measure * p.weight / width * double_well(c[q]).second;
                   }));
}

/// Without a chemical potential μ is just kept zero.
void add_no_potential(const std::vector<LayerPoint>& points, LocalSystem& local) {
    local.linear(potential, Op::value, potential, Op::value,
                 at_layer_points(points, [](const auto& p, std::size_t) { return p.measure * p.weight; }));
}

void add_molecule_terms(const std::vector<LayerPoint>& points, const MoleculeParameters& molecules, double tau,
                        LocalSystem& local) {
    add_conserved_rate(points, tau, concentration, concentration, local);
    switch (molecules.transport) {
        case Transport::cahn_hilliard:  // (40), (41)
            add_layer_diffusion(points, molecules.mobility, concentration, potential, local);
            add_chemical_potential(points, molecules.interface_width, local);
            break;
        case Transport::fickian:  // (39)
            add_layer_diffusion(points, molecules.diffusivity, concentration, concentration, local);
            [[fallthrough]];
        case Transport::advection:  // (14), with the diffusion across the layer that keeps c constant there
            add_normal_diffusion(points, molecules.normal_diffusivity, concentration, concentration, local);
            add_no_potential(points, local);
            break;
    }
}

}  // namespace

void advance_molecules(const Spaces& spaces, const Vector& flow_old, const Vector& flow_new,
                       const Parameters& parameters, double tau, LinearSystem& system, Vector& molecules) {
    const Space& space = spaces.molecules;
    const dealii::QGauss<2> quadrature(quadrature_points(parameters.phase_field));
    LayerFields layer(spaces, space, parameters, quadrature);
    LocalSystem local(space, quadrature);
    const unsigned int n = space.element.n_dofs_per_cell();
    dealii::FullMatrix<double> cell_matrix(n, n);
    dealii::Vector<double> cell_rhs(n), cell_values(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    std::vector<LayerPoint> points;

    system.start();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        cell->get_dof_values(molecules, cell_values);
        cell->get_dof_indices(indices);
        layer.evaluate_cell(same_cell(cell, spaces.flow), box, flow_old, flow_new, cell_values, points);
        local.start(box, cell_values);
        add_molecule_terms(points, parameters.molecules, tau, local);
        local.write(cell_matrix, cell_rhs);
        space.constraints.distribute_local_to_global(cell_matrix, cell_rhs, indices, system.matrix,
                                                     system.right_hand_side);
    }
    Vector increment = space.vector();
    system.solve(space.constraints, increment);
    molecules += increment;
    molecules.update_ghost_values();
}

}  // namespace endoflow::phasefield::paper
