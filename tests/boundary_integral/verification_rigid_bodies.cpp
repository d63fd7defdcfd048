// Rigid bodies in Stokes flow against reference/stokes.csv: the single layer on curved bodies of every aspect ratio,
// between surfaces that nearly touch, and beside a wall.

#include <catch2/catch.hpp>
#include <cmath>

#include "rigid_body.h"
#include "stokes_reference.h"

namespace {

using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

SpheroidalBody unit_sphere(double centre) {
    return {1, 1, centre};
}

struct Problem {
    const char* name;
    Surroundings surroundings;
    SpheroidalBody (*body)(double parameter);
    std::size_t rows;
};

double relative_error(const Problem& problem, const StokesRow& row, Index elements) {
    return std::abs(drag_factor(problem.body(row.parameter), problem.surroundings, elements) / row.factor - 1);
}

}  // namespace

TEST_CASE("drag of rigid bodies", "[verification]") {
    const Problem problem = GENERATE(
        // Stimson & Jeffery (1926): d/2a is the distance of the centre from the plane of symmetry.
        Problem{"stimson_jeffery", Surroundings::twin_moving_along, unit_sphere, 3},
        Problem{"opposite_spheres", Surroundings::twin_moving_opposite, unit_sphere, 2},
        Problem{"brenner_wall", Surroundings::wall, unit_sphere, 2},
        Problem{"spheroid_axial", Surroundings::nothing,
                [](double ratio) {
                    return SpheroidalBody{1, ratio};
                },
                3});
    const auto rows = stokes_reference(problem.name);
    REQUIRE(rows.size() == problem.rows);
    for (const StokesRow& row : rows) {
        const double coarse = relative_error(problem, row, 4), fine = relative_error(problem, row, 16);
        CAPTURE(problem.name, row.parameter, coarse, fine);
        // The hardest are a gap of a tenth of the radius (2e-6) and a tip with a tenth of the equator's radius (3e-7).
        CHECK(fine < 3e-6);
        // Quintic splines promise sixth order; in the widest gaps the fine error is already that of the quadrature.
        CHECK(std::log(coarse / fine) / std::log(4) > 5);
    }
}

TEST_CASE("Blake's images cancel the point force on the wall", "[verification]") {
    const Vector force_at = {0.3, -0.2, 0.7}, on_wall = {1.1, 0.5, 0};
    const auto image = image_stokeslet(on_wall, force_at);
    const Vector d = {on_wall[0] - force_at[0], on_wall[1] - force_at[1], on_wall[2] - force_at[2]};
    const double distance = std::hypot(d[0], d[1], d[2]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double direct = (i == j ? 1 / distance : 0) + d[i] * d[j] / std::pow(distance, 3);
            CHECK(std::abs(direct + image[i][j]) < 1e-14);
        }
}
