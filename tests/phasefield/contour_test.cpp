// The membrane curve from φ: points on a known surface, curvature, area.

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/contour/contour.h"
#include "phasefield/schemes/paper/bending.h"
#include "phasefield/schemes/paper/discretization.h"
#include "phasefield/schemes/production/fields.h"
#include "shared/geometry/observables.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

namespace {

/// φ of a cosine-shaped hill of height 6 nm: z = 20 + 3 (1 + cos(π r/40)), by the vertical distance.
double hill(double r) {
    return 20 + 3 * (1 + std::cos(M_PI * r / 40));
}

Contour contour_of_hill(double cell_size) {
    Parameters p = small_case();
    p.phase_field.cell_size = cell_size;
    p.phase_field.band_width = 6;
    Discretization d(p, MPI_COMM_SELF);
    State state = initial_state(d);
    std::vector<PlanePoint> curve;
    for (double r = 0; r <= 40; r += 0.2) curve.push_back({r, hill(r)});
    adapt(d, state, curve);
    std::vector<dealii::types::global_dof_index> indices(d.spaces.flow.element.n_dofs_per_cell());
    for (const auto& cell : d.spaces.flow.dofs.active_cell_iterators()) {
        cell->get_dof_indices(indices);
        const CellBox box = cell_box(cell);
        for (const unsigned int i : d.spaces.flow.local[phi]) {
            const auto x = d.spaces.flow.element.unit_support_point(i);
            const double r = box.r0 + x[0] * box.hr, z = box.z0 + x[1] * box.hz;
            state.flow(indices[i]) = equilibrium_profile(hill(r) - z, p.phase_field.epsilon);
        }
    }
    d.spaces.flow.hanging_nodes.distribute(state.flow);
    return extract_contour(contour_fields(d.spaces, state), p);
}

double largest_error(const MembraneCurve& curve) {
    double error = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) error = std::max(error, std::abs(curve.z[i] - hill(curve.r[i])));
    return error;
}

}  // namespace

TEST_CASE("the contour converges to the surface with the fourth order of cubic elements", "[contour]") {
    const auto coarse = contour_of_hill(2.5), fine = contour_of_hill(1.25);
    CHECK(fine.components == 1);
    CHECK(fine.curve.r.front() == 0);
    CHECK(fine.curve.r.back() == Approx(40).epsilon(1e-12));
    const double order = std::log2(largest_error(coarse.curve) / largest_error(fine.curve));
    INFO("errors " << largest_error(coarse.curve) << ", " << largest_error(fine.curve) << " nm");
    CHECK(order > 3);  // at least: the errors of interpolation are not smooth from cell to cell
    CHECK(largest_error(fine.curve) < 2e-3);
    // κ at the top: two principal curvatures −hill''(0) = 3 (π/40)² each
    CHECK(fine.curve.kappa.front() == Approx(2 * 3 * std::pow(M_PI / 40, 2)).epsilon(0.1));
    double area = 0;
    for (int i = 0; i < 4000; ++i) {
        const double r = 40 * (i + 0.5) / 4000, slope = -3 * M_PI / 40 * std::sin(M_PI * r / 40);
        area += 2 * M_PI * r * std::sqrt(1 + slope * slope) * 0.01;
    }
    CHECK(measure(fine.curve, BendingModel{MembraneParameters{}}).membrane_area == Approx(area).epsilon(1e-5));
}

TEST_CASE("the contour has no gap where it crosses a face between cells of two sizes twice", "[contour]") {
    Parameters p = small_case();
    p.phase_field.cell_size = 2.5;
    const double face = 20;
    const double finer_side = GENERATE(1, -1);  // the curve is on this side but for 0.4 nm, within half a coarse face
    const auto mesh = coarse_mesh(p, MPI_COMM_SELF);
    mesh->refine_global(static_cast<unsigned int>(p.phase_field.far_refinements));
    for (const auto& cell : mesh->active_cell_iterators())
        if (finer_side * (cell->center()[1] - face) > 0) cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    Space space(*mesh, production::field_degrees(p.phase_field));
    space.distribute();
    production::close_constraints(space, p);
    Vector solution = space.vector();
    const double a = finer_side * GENERATE(1e-3, -1e-3);
    interpolate(
        space, production::distance, [&](double r, double z) { return face + a * (r - 10.1) * (r - 10.5) - z; },
        solution);
    finish_interpolation(space, solution);
    solution.update_ghost_values();
    const Contour contour =
        extract_contour({&space, &solution, production::distance, production::velocity_r, production::velocity_z,
                         production::tension, 1, &space, &solution, production::molecule_density},
                        p);
    CHECK(contour.components == 1);
    for (std::size_t i = 0; i < contour.curve.size(); ++i) {
        const double r = contour.curve.r[i];
        CHECK(contour.curve.z[i] == Approx(face + a * (r - 10.1) * (r - 10.5)).epsilon(1e-10));
    }
}
