// The scheme with one unknown more, w = c², added by the recipe of docs/extending.md: a row and an equation.

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "../one_step.h"
#include "../small_case.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "shared/output/atomic_file.h"
#include "shared/output/field_index.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// The largest |w − c²| at the unknowns' own points, where w of the same degree can be c² itself.
double largest_difference(const Space& space, const Vector& solution, double& largest_density) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    double largest = 0;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        cell->get_dof_indices(indices);
        std::vector<double> density, squared;
        for (unsigned int i = 0; i < indices.size(); ++i) {
            const unsigned int component = space.element.system_to_component_index(i).first;
            if (component == molecule_density) density.push_back(solution(indices[i]));
            if (component == squared_density) squared.push_back(solution(indices[i]));
        }
        REQUIRE(density.size() == squared.size());
        for (std::size_t i = 0; i < density.size(); ++i) {
            largest = std::max(largest, std::abs(squared[i] - density[i] * density[i]));
            largest_density = std::max(largest_density, density[i]);
        }
    }
    return largest;
}

std::string fields_of(const ProductionScheme& scheme, const std::filesystem::path& directory, double time) {
    std::vector<double> times;
    scheme.write_fields(directory, times, time);
    return read_file(field_file({directory}, 0), 1 << 24);
}

}  // namespace

TEST_CASE("an added unknown is in the table that everything reads", "[recipe]") {
    REQUIRE(unknowns().size() == 12);
    CHECK(unknowns().back().field == squared_density);
    CHECK(field_degrees(small_case().phase_field).size() == 12);
}

TEST_CASE("an added unknown starts with its initial value and is solved for", "[recipe]") {
    const Parameters p = small_case();
    OneStep one(p, 1e-9);
    const StepNumbers numbers = step_numbers(p, 2e4, 1000);
    Vector x = initial_fields(one.space, p, one.energy.density);
    x.update_ghost_values();
    double density = 0;
    CHECK(largest_difference(one.space, x, density) < 1e-14);
    CHECK(density == Approx(1).margin(0.05));

    const std::vector<Vector> past{x};
    past.front().update_ghost_values();
    const StepPast history(one.space, numbers, past, {-2e4}, {1}, past.front());
    Vector guess = x;
    scale_component(one.space, squared_density, 0.5, guess);  // the equation, not the start, must give it
    guess.update_ghost_values();
    one.solver.solve(one.space, numbers, history, guess);
    // The projection of c² on w's polynomials, c's own: (h/ε_c)⁴/200 of the edge between them.
    CHECK(largest_difference(one.space, guess, density) < 0.02);
}

TEST_CASE("an added unknown is written to field files and kept in checkpoints", "[recipe]") {
    const auto directory =
        std::filesystem::temp_directory_path() / ("endoflow_added_unknown_" + std::to_string(getpid()));
    ProductionScheme scheme(small_case(), MPI_COMM_SELF), continued(small_case(), MPI_COMM_SELF);
    scheme.start();
    const StepOutcome step = scheme.attempt(0, 2e-5);
    REQUIRE(step.rejection.empty());
    scheme.keep(0, 2e-5, step);
    const std::string written = fields_of(scheme, directory, 2e-5);
    CHECK_THAT(written, Catch::Matchers::Contains("\"c_squared\""));
    Checkpoint checkpoint;
    scheme.save(directory / "checkpoint", checkpoint);
    continued.load(directory / "checkpoint", checkpoint);
    CHECK(fields_of(continued, directory, 2e-5) == written);
    std::filesystem::remove_all(directory);
}
