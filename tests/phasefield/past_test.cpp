// What a step takes from the solutions before it.

#include "phasefield/schemes/production/past.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "one_step.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/fields.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;
using namespace endoflow::phasefield::production;

namespace {

/// Largest angle in the layer between the normal along which c is held and that of a plane which turns by `turn` [rad]
/// in every step, known from three steps before.
double largest_deviation(double turn) {
    const Parameters p = small_case();
    const double r0 = 0.5 * p.domain.radius, z0 = p.domain.membrane_height, epsilon = p.phase_field.epsilon;
    const auto mesh = coarse_mesh(p, MPI_COMM_SELF);
    Space space(*mesh, field_degrees(p.phase_field));
    space.distribute();
    space.constraints.close();
    const auto plane = [&](double angle, double r, double z) {
        return (r - r0) * std::sin(angle) - (z - z0) * std::cos(angle);
    };
    std::vector<Vector> past(3, space.vector());  // newest first
    double angle = 2 * turn;
    for (Vector& x : past) {
        interpolate(
            space, distance, [&](double r, double z) { return plane(angle, r, z); }, x);
        finish_interpolation(space, x);
        x.update_ghost_values();
        angle -= turn;
    }
    const StepNumbers numbers = step_numbers(p, 2000, 1000);
    const StepPast history(space, numbers, past, {-6000, 3000, -667}, {3, -3, 1}, past[0]);

    double largest = 0;
    const dealii::QGauss<2> quadrature(gauss_points(p.phase_field));
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        const CellBox box = cell_box(cell);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double r = box.r0 + box.hr * quadrature.point(q)[0], z = box.z0 + box.hz * quadrature.point(q)[1];
            if (std::abs(equilibrium_profile(plane(2 * turn, r, z), epsilon)) > layer_edge) continue;
            const Direction n = history.points[cell->active_cell_index()][q].molecules_normal;
            largest = std::max(largest, std::abs(std::atan2(n.r, -n.z) - 3 * turn));
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("molecules are held along the normal at the step's end", "[history]") {
    // A unit vector turning by α per step is extrapolated through three with an error of α³. Where (1 − φ²)² is no more
    // than 0.036, at |φ| = 0.9, 1e-4/0.036 of the last normal is mixed in, which lags by α.
    for (const double turn : {0.1, 0.05}) {
        const double third_order = std::pow(turn, 3), lag = turn * 1e-4 / std::pow(1 - layer_edge * layer_edge, 2);
        CAPTURE(turn);
        CHECK(largest_deviation(turn) < 1.02 * (third_order + lag));
        CHECK(largest_deviation(turn) > 0.9 * third_order);
    }
}
