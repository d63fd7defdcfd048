// The distance from the membrane, and ψ outside of the layer.

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "one_step.h"
#include "phasefield/contour/closest_normal.h"
#include "phasefield/fem/component_field.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// Largest error of ψ [nm] between the plane and `depth` above it.
double largest_error(const Space& space, const Parameters& p, const Vector& x, double depth) {
    const dealii::QGauss<2> quadrature(gauss_points(p.phase_field));
    ComponentField field(space, distance, quadrature);
    double largest = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        const CellBox box = cell_box(cell);
        const auto& psi = field.on(cell, box, x);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double above = box.z0 + box.hz * quadrature.point(q)[1] - p.domain.membrane_height;
            if (above > 0 && above < depth) largest = std::max(largest, std::abs(psi.value[q] + above));
        }
    }
    return largest;
}

/// Largest error of the normals [rad] up to 6 nm from the parabola z = r²/20 nm, known by `count` chords from the axis
/// to r = 30 nm.
double largest_normal_error(int count) {
    constexpr double radius = 10, z0 = 50;  // of curvature on the axis [nm]
    const auto at = [&](double r) {
        const double length = std::hypot(r, radius);
        ContourPoint point{r, z0 + r * r / (2 * radius)};
        point.normal_r = -r / length;
        point.normal_z = radius / length;
        return point;
    };
    std::vector<ContourSegment> chords;
    for (int i = 0; i < count; ++i) chords.push_back({at(30.0 * i / count), at(30.0 * (i + 1) / count)});
    ClosestNormal normals(chords);
    double largest = 0;
    for (double r = 0.1; r < 25; r += 0.37)
        for (const double away : {-6.0, -2.0, 1e-3, 3.0, 6.0}) {
            const ContourPoint foot = at(r);
            const double x = foot.r + away * foot.normal_r, z = foot.z + away * foot.normal_z;
            if (x < 0) continue;
            normals.start({2 * std::floor(x / 2), 2 * std::floor(z / 2), 2, 2});
            const PlanePoint n = normals.at(x, z);
            largest = std::max(largest, std::abs(n.r * foot.normal_z - n.z * foot.normal_r));
        }
    return largest;
}

}  // namespace

TEST_CASE("the normal at the closest point of a contour is of second order", "[distance]") {
    // Without Newton's method the normal is that of the chord's end wherever the end is closest: on the convex side, 6
    // nm away, it is off by up to 6/20 of the chord's angle, of first order.
    const double coarse = largest_normal_error(15), fine = largest_normal_error(30);
    CAPTURE(coarse, fine);
    CHECK(fine < 0.01);
    CHECK(std::log2(coarse / fine) > 1.8);
}

TEST_CASE("a pit in the distance outside of the layer fills up", "[distance]") {
    Parameters p = small_case();
    p.domain.height = 60;
    p.domain.membrane_height = 20;
    p.phase_field.far_refinements = 0;
    OneStep one(p);
    const StepNumbers numbers = step_numbers(p, 20, 1000);
    const Space& space = one.space;
    // 6 nm deep and 2.5 nm wide, on the axis 18 nm above a flat membrane at rest: |∇ψ| is up to 2.1 towards its bottom,
    // so that the normals around it point away from the membrane.
    const auto with_pit = [&](double r, double z) {
        const double above = z - p.domain.membrane_height;
        return -above + 6 * std::exp(-(r * r + std::pow(above - 18, 2)) / 6.25);
    };
    std::vector<Vector> past{space.vector()};
    interpolate(space, distance, with_pit, past[0]);
    interpolate(
        space, membrane_stretch, [](double, double) { return 1.0; }, past[0]);
    finish_interpolation(space, past[0]);
    past[0].update_ghost_values();
    REQUIRE(largest_error(space, p, past[0], 28) > 5.9);
    for (int step = 0; step < 6; ++step) {
        const StepPast history(space, numbers, past, {-numbers.rate}, {1}, past[0]);
        Vector x = past[0];
        one.solver.solve({space, one.energy, numbers, history}, x, 1e-6);
        past[0] = x;
    }
    // What keeps ∂ψ/∂n from step to step lets a fifth of the pit stay in each; measured 1.3e-4 nm after six, 3e-6 nm in
    // the layer.
    CHECK(largest_error(space, p, past[0], 28) < 5e-4);
    CHECK(largest_error(space, p, past[0], 8) < 1e-5);
}
