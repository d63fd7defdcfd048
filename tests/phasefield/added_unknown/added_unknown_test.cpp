// The scheme with one unknown more, w − ε² Δw = c², added by the recipe of docs/extending.md: a row and an equation.

#include <deal.II/base/quadrature_lib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "../../shared/temporary_directory.h"
#include "../one_step.h"
#include "../small_case.h"
#include "phasefield/fem/component_field.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "shared/output/atomic_file.h"
#include "shared/output/field_index.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// ∫ ((w − c²) v + ε² ∇w·∇v) r dr dz, the equation tested with one of the fields v, over ∫ c² |v|.
double relative_residual(const Space& space, const Parameters& p, const Vector& x, Field tested_with) {
    const dealii::QGauss<2> quadrature(gauss_points(p.phase_field));
    ComponentField w_field(space, blurred_square, quadrature), c_field(space, molecule_density, quadrature),
        v_field(space, tested_with, quadrature);
    const double squared_width = p.phase_field.epsilon * p.phase_field.epsilon;
    double residual = 0, size = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        const CellBox box = cell_box(cell);
        const auto &w = w_field.on(cell, box, x), &c = c_field.on(cell, box, x), &v = v_field.on(cell, box, x);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double measure = quadrature.weight(q) * box.hr * box.hz * (box.r0 + box.hr * quadrature.point(q)[0]);
            const double square = c.value[q] * c.value[q];
            residual +=
                measure * ((w.value[q] - square) * v.value[q] + squared_width * (w.r[q] * v.r[q] + w.z[q] * v.z[q]));
            size += measure * square * std::abs(v.value[q]);
        }
    }
    return std::abs(residual) / size;
}

/// What the field file of a time [µs] has of the unknown.
std::string written(const ProductionScheme& scheme, const std::filesystem::path& directory, double time) {
    std::vector<double> times;
    scheme.write_fields(directory, times, time);
    const std::string file = read_file(field_file({directory}, 0), 1 << 24);
    const auto begin = file.find("Name=\"blurred_square\"");
    REQUIRE(begin != std::string::npos);
    return file.substr(begin, file.find("</DataArray>", begin) - begin);
}

}  // namespace

TEST_CASE("an added unknown is in the table that everything reads", "[recipe]") {
    REQUIRE(unknowns().size() == 12);
    CHECK(unknowns().back().field == blurred_square);
    CHECK(field_degrees(small_case().phase_field).size() == 12);
}

TEST_CASE("an added unknown starts with its initial value and is solved for", "[recipe]") {
    const Parameters p = small_case();
    OneStep one(p);
    const StepNumbers numbers = step_numbers(p, 2e4, 1000);
    Vector x = initial_fields(one.space, p, one.energy.density);
    x.update_ghost_values();
    const std::vector<Vector> past{x};
    past.front().update_ghost_values();
    const StepPast history(one.space, numbers, past, {-2e4}, {1}, past.front());
    // At the start w = c² without a blur. Newton's method ends when ψ changes by less than 1e-12 nm; what it then
    // leaves of this equation was measured to be below 5e-11, with 1e-10 nm 3e-10: c follows w in each sweep.
    for (const Field tested_with : {molecule_density, blurred_square})
        CHECK(relative_residual(one.space, p, x, tested_with) == Approx(0.09).margin(0.02));
    one.solver.solve({one.space, one.energy, numbers, history}, x, 1e-12);
    for (const Field tested_with : {molecule_density, blurred_square})
        CHECK(relative_residual(one.space, p, x, tested_with) < 1e-10);
}

TEST_CASE("an added unknown is written to field files and kept in checkpoints", "[recipe]") {
    const TemporaryDirectory scratch;
    const auto& directory = scratch.path();
    ProductionScheme scheme(small_case(), MPI_COMM_SELF), continued(small_case(), MPI_COMM_SELF);
    scheme.start();
    const StepOutcome step = scheme.attempt(0, 2e-5);
    REQUIRE(step.rejection.empty());
    scheme.keep(0, 2e-5, step);
    Checkpoint checkpoint;
    scheme.save(directory / "checkpoint", checkpoint);
    continued.load(directory / "checkpoint", checkpoint);
    CHECK(written(continued, directory, 2e-5) == written(scheme, directory, 2e-5));
    CHECK(written(continued, directory, 2e-5) != written(scheme, directory, 0));
}
