// Conservation of molecules and membrane, transfer between meshes.

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/contour/contour.h"
#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/paper/paper_step.h"
#include "shared/geometry/observables.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

namespace {

double mass_drift(Transport transport) {
    Parameters p = small_case();
    p.molecules.transport = transport;
    Discretization d(p, MPI_COMM_SELF);
    State state = initial_state(d);
    const double before = integrate_layer(d.spaces, state, p).molecules;
    for (int step = 0; step < 3; ++step) state = advance(d, state, 1e-4);
    return integrate_layer(d.spaces, state, p).molecules / before - 1;
}

/// −2πR ∫ ½ |∂φ/∂z| u_r dz on r = R, by the trapezoidal rule on eight intervals per cell.
double rim_inflow(const Space& flow, const Vector& values) {
    std::vector<dealii::Point<2>> points;
    for (int i = 0; i <= 8; ++i) points.emplace_back(1.0, i / 8.0);
    const dealii::Quadrature<2> wall(points);
    const ScalarBasis velocity(flow.degrees[u_r], wall), profile(flow.degrees[phi], wall);
    dealii::Vector<double> cell_values(flow.element.n_dofs_per_cell());
    std::vector<double> coefficients;
    ScalarField u, p;
    double sum = 0;
    for (const auto& cell : flow.dofs.active_cell_iterators()) {
        if (!cell->face(1)->at_boundary()) continue;
        const CellBox box = cell_box(cell);
        cell->get_dof_values(values, cell_values);
        component_values(flow, u_r, cell_values, coefficients);
        evaluate(velocity, box, coefficients, Derivatives::first, u);
        component_values(flow, phi, cell_values, coefficients);
        evaluate(profile, box, coefficients, Derivatives::first, p);
        for (unsigned int i = 0; i <= 8; ++i)
            sum -= (i % 8 == 0 ? 0.5 : 1) * box.hz / 8 * 2 * M_PI * (box.r0 + box.hr) * 0.5 * std::abs(p.z[i]) *
                   u.value[i];
    }
    return sum;
}

}  // namespace

TEST_CASE("every law of transport conserves the molecules to round-off", "[transport]") {
    // Σ over ~1e4 unknowns of a solution accurate to 1e-11
    CHECK(std::abs(mass_drift(Transport::cahn_hilliard)) < 1e-10);
    CHECK(std::abs(mass_drift(Transport::fickian)) < 1e-10);
    CHECK(std::abs(mass_drift(Transport::advection)) < 1e-10);
}

TEST_CASE("the initial layer has the membrane's area and the patch's molecules", "[transport]") {
    const Parameters p = small_case();
    Discretization d(p, MPI_COMM_SELF);
    const State state = initial_state(d);
    const auto layer = integrate_layer(d.spaces, state, p);
    CHECK(layer.area == Approx(M_PI * 1600).epsilon(1e-4));  // |φ| < 1 − 2e-5 at the bottom and the top
    const auto observables =
        measure(extract_contour(contour_fields(d.spaces, state), p).curve, BendingModel(p.membrane));
    CHECK(layer.molecules == Approx(observables.molecule_mass).epsilon(1e-4));
}

TEST_CASE("stretching is conserved but for what flows in at the rim", "[transport]") {
    const Parameters p = small_case();
    Discretization d(p, MPI_COMM_SELF);
    State state = initial_state(d);
    const double before = integrate_layer(d.spaces, state, p).stretching;
    const double tau = 1e-4;
    state = advance(d, state, tau);
    const double after = integrate_layer(d.spaces, state, p).stretching;
    const double inflow = tau * rim_inflow(d.spaces.flow, state.flow);
    INFO("gained " << after - before << ", flowed in " << inflow);
    CHECK(after - before == Approx(inflow).epsilon(5e-3));  // the trapezoidal rule; P_rr ≈ 1
    CHECK(after != before);
}

TEST_CASE("adapting the mesh leaves the layer as it is", "[transport]") {
    Parameters p = small_case();
    p.domain.height = 80;
    p.domain.membrane_height = 40;
    p.phase_field.band_width = 6;
    Discretization d(p, MPI_COMM_SELF);
    State state = initial_state(d);
    for (int step = 0; step < 2; ++step) state = advance(d, state, 1e-4);
    const auto before = integrate_layer(d.spaces, state, p);
    const auto contour = extract_contour(contour_fields(d.spaces, state), p);
    const auto cells = d.mesh->n_global_active_cells();
    auto shifted = positions(contour.curve);
    for (auto& point : shifted) point.z += 3;  // more than a cell, less than the margin beyond the layer
    REQUIRE(adapt(d, state, shifted));
    CHECK(d.mesh->n_global_active_cells() >= cells);
    const auto after = integrate_layer(d.spaces, state, p);
    CHECK(after.molecules == Approx(before.molecules).epsilon(1e-13));
    CHECK(after.stretching == Approx(before.stretching).epsilon(1e-13));
    const auto again = extract_contour(contour_fields(d.spaces, state), p);
    REQUIRE(again.curve.size() == contour.curve.size());
    for (std::size_t i = 0; i < again.curve.size(); ++i)
        REQUIRE(again.curve.z[i] == Approx(contour.curve.z[i]).margin(1e-9));
}
