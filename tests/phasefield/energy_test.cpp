// The membrane force g is the variation of the discrete energy.

#include <deal.II/base/quadrature_lib.h>
#include <algorithm>
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

/// Largest difference of a component of two states on one mesh, relative to its largest value.
double difference(const Space& space, unsigned int component, const Vector& a, const Vector& b) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    double largest = 0, scale = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        cell->get_dof_indices(indices);
        for (const unsigned int i : space.local[component]) {
            largest = std::max(largest, std::abs(a(indices[i]) - b(indices[i])));
            scale = std::max(scale, std::abs(b(indices[i])));
        }
    }
    return largest / scale;
}

/// Three steps of 1e-5 µs with the unknown of (37) as given.
State three_steps(Parameters p, BendingUnknown unknown) {
    p.phase_field.paper.bending_unknown = unknown;
    Discretization d(p, MPI_COMM_SELF);
    State state = initial_state(d);
    for (int step = 0; step < 3; ++step) state = advance(d, state, 1e-5);
    return state;
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

TEST_CASE("f as the unknown of (37) is the moment divided by β", "[energy]") {
    Parameters p = small_case();
    Discretization d(p, MPI_COMM_SELF);
    initial_state(d);  // the layout of the spaces
    const auto change = [&](unsigned int component) {
        const State f = three_steps(p, BendingUnknown::f), m = three_steps(p, BendingUnknown::moment);
        return difference(d.spaces.flow, component, f.flow, m.flow);
    };
    // Where β is the same everywhere the two are one scheme, up to the linear solver's 1e-11 and the 1e3 or so by which
    // g, a fourth derivative on cells of 2.5 nm, magnifies it.
    p.membrane.bending_stiffness_coated = p.membrane.bending_stiffness;
    CHECK(change(phi) < 1e-9);
    CHECK(change(u_z) < 1e-7);
    // Where it varies they interpolate different functions: they agree up to the discretization.
    p.membrane.bending_stiffness_coated = 12 * p.membrane.bending_stiffness;
    CHECK(change(phi) > 1e-7);
    CHECK(change(u_z) < 0.05);
}

TEST_CASE("+g ∇φ lowers the energy, −g ∇φ of Sec. 3 raises it", "[energy]") {
    const auto growth = [](ForceSign sign) {
        Parameters p = small_case();
        p.phase_field.paper.force_sign = sign;
        Discretization d(p, MPI_COMM_SELF);
        const State start = initial_state(d);
        const double before = diagnose_step(d.spaces, start, start, 0, p).bending_energy;
        State state = start;
        for (int step = 0; step < 3; ++step) state = advance(d, state, 1e-6);
        return diagnose_step(d.spaces, state, state, 0, p).bending_energy / before - 1;
    };
    CHECK(growth(ForceSign::plus) < -1e-4);
    CHECK(growth(ForceSign::minus) > 1e-4);
}
