// The membrane force g is the variation of the discrete energy.

#include <deal.II/base/quadrature_lib.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/paper/paper_step.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

namespace {

/// Adds amplitude × a smooth bump, zero with its slope at r = R, to φ.
void displace(const Space& space, double amplitude, Vector& flow) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    Vector bump = space.vector();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        cell->get_dof_indices(indices);
        const CellBox box = cell_box(cell);
        for (const unsigned int i : space.local[phi]) {
            const auto x = space.element.unit_support_point(i);
            const double r = box.r0 + x[0] * box.hr, z = box.z0 + x[1] * box.hz - 20;
            bump(indices[i]) = std::pow(1 - r * r / 1600, 2) * std::cos(0.15 * r) * std::exp(-z * z / 30 + 0.1 * z);
        }
    }
    space.hanging_nodes.distribute(bump);
    flow.add(amplitude, bump);
    flow.update_ghost_values();
}

/// f and g that belong to φ: a vanishing time step leaves φ alone and solves (36) and (37).
State equilibrate(Discretization& d, const State& state) {
    d.coupled.forget_factors();
    return advance(d, state, 1e-13);
}

}  // namespace

TEST_CASE("∫ g δφ is the change of the discrete bending energy", "[energy]") {
    Parameters p = small_case();
    p.fluid.dynamics = Dynamics::geometric;
    p.phase_field.paper.mobility = 1e-3;
    Discretization d(p, MPI_COMM_SELF);
    State base = initial_state(d);
    displace(d.spaces.flow, 0.1, base.flow);  // away from the flat membrane
    base = equilibrate(d, base);

    const double h = 1e-4;
    const auto energy = [&](double amplitude) {
        State moved = base;
        displace(d.spaces.flow, amplitude, moved.flow);
        moved = equilibrate(d, moved);
        return diagnose_step(d.spaces, moved, moved, 0, p).bending_energy;
    };
    const double difference = (energy(h) - energy(-h)) / (2 * h);

    Vector direction = d.spaces.flow.vector();
    displace(d.spaces.flow, 1, direction);
    const dealii::QGauss<2> quadrature(quadrature_points(p.phase_field));
    LocalSystem now(d.spaces.flow, quadrature), along(d.spaces.flow, quadrature);
    dealii::Vector<double> values(d.spaces.flow.element.n_dofs_per_cell());
    double variation = 0;
    for (const auto& cell : d.spaces.flow.dofs.active_cell_iterators()) {
        const CellBox box = cell_box(cell);
        cell->get_dof_values(base.flow, values);
        now.start(box, values);
        cell->get_dof_values(direction, values);
        along.start(box, values);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
            variation += 2 * M_PI * (box.r0 + box.hr * quadrature.point(q)[0]) * quadrature.weight(q) * box.hr *
                         box.hz * now.field(force).value[q] * along.field(phi).value[q];
    }
    INFO("finite difference " << difference << ", ∫ g δφ " << variation);
    // The two agree exactly but for the difference quotient's h² and the linear solver's 1e-11.
    CHECK(variation == Approx(difference).epsilon(1e-5));
    CHECK(std::abs(variation) > 1);
}
