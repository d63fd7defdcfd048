// Eliminating the unknowns inside of the cells does not change the solution of a linear system.

#include <dmumps_c.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "phasefield/fem/mesh.h"
#include "phasefield/solver/block_gauss_seidel.h"
#include "phasefield/solver/condensed_system.h"
#include "phasefield/solver/mumps_ordering.h"
#include "shared/support/error.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;

namespace {

constexpr int refinements = 3;

/// A system without symmetry, its rows of sizes as different as those of fields that only live on the membrane, on a
/// mesh with cells of three sizes: solved whole and condensed.
struct WholeAndCondensed {
    WholeAndCondensed(MPI_Comm communicator_, bool second_component)
        : communicator(communicator_),
          mesh(coarse_mesh(small_case(), communicator)),
          space(*mesh, {3, 2}),
          whole(communicator, "whole"),
          condensed(communicator, "condensed", {0, 1}) {
        for (const auto& cell : mesh->active_cell_iterators())
            if (cell->is_locally_owned() && cell->center()[0] < 12 && std::abs(cell->center()[1] - 20) < 8)
                cell->set_refine_flag();
        mesh->execute_coarsening_and_refinement();
        space.distribute();
        for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                         dealii::types::global_dof_index index, double /*z*/) {
            if (boundary == axis && component == 0 && !space.constraints.is_constrained(index))
                space.constraints.add_line(index);
        });
        if (!second_component) switch_off(space, {1});
        space.constraints.close();
        Couplings full(2, 2);
        full.fill(dealii::DoFTools::always);
        whole.reinit(space, full);
        condensed.reinit(space, scattered());
    }

    [[nodiscard]] dealii::FullMatrix<double> cell_matrix(const CondensedSystem::Cell& cell) const {
        const unsigned int n = space.element.n_dofs_per_cell();
        dealii::FullMatrix<double> matrix(n, n);
        const auto center = cell->center();
        for (unsigned int i = 0; i < n; ++i) {
            const double size = std::pow(10.0, i % 5) * cell->measure();
            for (unsigned int k = 0; k < n; ++k)
                matrix(i, k) = size * (std::cos(1.7 * i - 0.9 * k + center[0] + 3 * center[1]) + (i == k ? 8 : 0));
        }
        return matrix;
    }

    /// `shift` makes it another right-hand side.
    [[nodiscard]] dealii::Vector<double> cell_right_hand_side(const CondensedSystem::Cell& cell, double shift) const {
        dealii::Vector<double> out(space.element.n_dofs_per_cell());
        for (unsigned int i = 0; i < out.size(); ++i) out(i) = std::sin(shift + 0.6 * i + 2 * cell->center()[1]);
        return out;
    }

    template <class Visit>
    void on_own_cells(const Visit& visit) {
        std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
        for (const auto& cell : space.dofs.active_cell_iterators()) {
            if (!cell->is_locally_owned()) continue;
            cell->get_dof_indices(indices);
            visit(cell, indices);
        }
    }

    /// The process that eliminates each own cell: by the cell's height, wherever it is computed.
    [[nodiscard]] std::vector<unsigned int> scattered() const {
        const auto processes = dealii::Utilities::MPI::n_mpi_processes(communicator);
        std::vector<unsigned int> out;
        for (const auto& cell : mesh->active_cell_iterators())
            if (cell->is_locally_owned())
                out.push_back(static_cast<unsigned int>(cell->center()[1] / small_case().domain.height * processes));
        return out;
    }

    /// The largest difference of the two solutions, as part of the largest value. Collective.
    double difference() {
        expected = found = space.vector();
        whole.start();
        on_own_cells([&](const auto& cell, const auto& indices) {
            const auto matrix = cell_matrix(cell);
            const auto rhs = cell_right_hand_side(cell, 0);
            space.constraints.distribute_local_to_global(matrix, rhs, indices, whole.matrix, whole.right_hand_side);
            condensed.set(cell, matrix);
            condensed.set(cell, rhs);
        });
        whole.solve(space.constraints, expected);
        condensed.solve(space, found);
        return distance(expected, found);
    }

    /// The same after iterative refinement: the factors applied to the residual, found in double precision. After
    /// difference().
    double refined_difference() {
        dealii::Vector<double> values(space.element.n_dofs_per_cell());
        for (int k = 0; k < refinements; ++k) {
            on_own_cells([&](const auto& cell, const auto& /*indices*/) {
                cell->get_dof_values(found, values);
                auto residual = cell_right_hand_side(cell, 0);
                values *= -1;
                cell_matrix(cell).vmult_add(residual, values);
                condensed.set(cell, residual);
            });
            Vector increment = space.vector();
            condensed.apply_factors(space, increment);
            found.zero_out_ghost_values();
            found += increment;
            found.update_ghost_values();
        }
        return distance(expected, found);
    }

    /// The same for another right-hand side with the same factors.
    double difference_with_old_factors() {
        expected = found = space.vector();
        whole.right_hand_side = 0;
        on_own_cells([&](const auto& cell, const auto& indices) {
            const auto rhs = cell_right_hand_side(cell, 0.4);
            space.constraints.distribute_local_to_global(rhs, indices, whole.right_hand_side);
            condensed.set(cell, rhs);
        });
        whole.apply_factors(space.constraints, expected);
        condensed.apply_factors(space, found);
        return distance(expected, found);
    }

    static double distance(const Vector& expected, Vector found) {
        const double size = expected.linfty_norm();
        found -= expected;
        return found.linfty_norm() / size;
    }

    MPI_Comm communicator;
    std::unique_ptr<Mesh> mesh;
    Space space;
    LinearSystem whole;
    CondensedSystem condensed;
    Vector expected, found;
};

/// The name of the error, if there is one, when all cells have this matrix times their own.
std::string failure(WholeAndCondensed& problem, double factor) {
    try {
        problem.on_own_cells([&](const auto& cell, const auto& /*indices*/) {
            auto matrix = problem.cell_matrix(cell);
            matrix *= factor;
            problem.condensed.set(cell, matrix);
            problem.condensed.set(cell, problem.cell_right_hand_side(cell, 0));
        });
        Vector solution = problem.space.vector();
        problem.condensed.solve(problem.space, solution);
    } catch (const SolverError& error) {
        return error.name();
    }
    return "none";
}

/// The own part of the solution of a system between processes. Each has `count` numbers from its rank on and a matrix
/// of its own.
dealii::Vector<double> shared_solution(InterfaceSystem& system, unsigned int count) {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                       processes = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::vector<InterfaceSystem::Index> numbers(count);
    std::iota(numbers.begin(), numbers.end(), rank);
    dealii::IndexSet owned(processes + count - 1);
    owned.add_range(rank, rank + 1);
    if (rank + 1 == processes) owned.add_range(rank + 1, rank + count);
    system.reinit(owned, numbers);
    dealii::FullMatrix<double> matrix(count, count);
    dealii::Vector<double> values(count);
    for (unsigned int i = 0; i < count; ++i) {
        values(i) = 1 + rank + 0.5 * i;
        for (unsigned int k = 0; k < count; ++k)
            matrix(i, k) = std::cos(1.3 * i - 0.7 * k + rank) + (i == k ? 5.0 + count : 0);
    }
    REQUIRE(system.factorise(matrix));
    system.solve(values);  // with new factors, then with old ones
    system.solve(values);
    return values;
}

/// INFOG(7): the ordering that MUMPS takes for a complete graph when it is asked for this one.
int ordering_taken(MumpsOrdering wanted) {
    constexpr int size = 50;
    std::vector<int> rows, columns;
    for (int i = 1; i <= size; ++i)
        for (int k = 1; k <= size; ++k) {
            rows.push_back(i);
            columns.push_back(k);
        }
    DMUMPS_STRUC_C data{};
    const auto run = [&](int job) {
        data.job = job;
        dmumps_c(&data);
        REQUIRE(data.infog[0] == 0);
    };
    data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_SELF));
    data.par = 1;
    run(-1);
    for (int stream = 0; stream < 4; ++stream) data.icntl[stream] = stream < 3 ? -1 : 0;  // no output
    data.icntl[5] = 0;
    data.icntl[6] = static_cast<int>(wanted);
    data.n = size;
    data.nnz = size * size;
    data.irn = rows.data();
    data.jcn = columns.data();
    run(1);
    const int taken = data.infog[6];
    run(-2);
    return taken;
}

// Both are direct solvers, so that they differ by round-off times the condition number, up to some 1e4: that of single
// precision in the condensed system's factors, that of double precision after refinement.
constexpr double single_round_off = 1e-6, round_off = 1e-11;

}  // namespace

TEST_CASE("MUMPS has the orderings that it is asked for", "[condensation]") {
    for (const auto wanted : {MumpsOrdering::approximate_minimum_fill, MumpsOrdering::minimum_degree_of_quasi_dense})
        CHECK(ordering_taken(wanted) == static_cast<int>(wanted));
}

TEST_CASE("a condensed system has the same solution", "[condensation]") {
    for (const bool second_component : {true, false}) {
        CAPTURE(second_component);
        WholeAndCondensed problem(MPI_COMM_SELF, second_component);
        REQUIRE(problem.space.hanging_nodes.n_constraints() > 0);
        CHECK(problem.difference() < single_round_off);
        CHECK(problem.refined_difference() < round_off);
        CHECK(problem.difference_with_old_factors() < single_round_off);
        problem.condensed.use(Precision::full);
        CHECK(problem.difference() < round_off);
        CHECK(problem.difference_with_old_factors() < round_off);
    }
}

TEST_CASE("on a new mesh single precision is tried again", "[condensation]") {
    WholeAndCondensed problem(MPI_COMM_SELF, true);
    problem.condensed.use(Precision::full);
    problem.condensed.reinit(problem.space, problem.scattered());
    CHECK(problem.condensed.precision() == Precision::single);
    CHECK(problem.difference() < single_round_off);
}

TEMPLATE_TEST_CASE("a process may share all of its unknowns with others", "[condensation]", float, double) {
    CellMatrices cells;
    cells.size = 2;
    cells.begin = {1, 3, 4};
    cells.unknowns = {2, 1, 1};  // the first cell numbers them the other way round
    std::vector<TestType> entries{0.25, 1, -2, 2.5, 0.5};
    dealii::FullMatrix<double> matrix(2, 2);
    matrix(0, 0) = 3;
    matrix(0, 1) = 1;
    matrix(1, 0) = -2;
    matrix(1, 1) = 0.25;
    dealii::Vector<double> values(2), out(2);
    values(0) = 5;
    values(1) = 7;
    const auto factors = mumps_factors<TestType>(cells, 2);
    dealii::FullMatrix<double> left;
    REQUIRE(factors->factorise(entries, left));
    for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int k = 0; k < 2; ++k) CHECK(left(i, k) == matrix(i, k));
    REQUIRE(factors->reduce(values, out));
    CHECK(out == values);
    REQUIRE(factors->expand(values, out));
    CHECK(out == values);
}

TEST_CASE("a condensed system has the same solution on several processes", "[condensation][mpi]") {
    WholeAndCondensed problem(MPI_COMM_WORLD, true);
    CHECK(problem.difference() < single_round_off);
    CHECK(problem.refined_difference() < round_off);
    CHECK(problem.difference_with_old_factors() < single_round_off);
}

TEST_CASE("a sweep is exact where the first block does not feel the second", "[condensation][mpi]") {
    WholeAndCondensed problem(MPI_COMM_WORLD, true);
    const Space& space = problem.space;
    BlockGaussSeidel sweep(MPI_COMM_WORLD, "sweep", {{0}, {1}});
    sweep.reinit(space, problem.scattered());
    problem.whole.start();
    problem.on_own_cells([&](const auto& cell, const auto& indices) {
        auto matrix = problem.cell_matrix(cell);
        for (const unsigned int i : space.local[0])
            for (const unsigned int k : space.local[1]) matrix(i, k) = 0;
        const auto rhs = problem.cell_right_hand_side(cell, 0);
        sweep.set(cell, matrix, rhs);
        space.constraints.distribute_local_to_global(matrix, rhs, indices, problem.whole.matrix,
                                                     problem.whole.right_hand_side);
    });
    Vector expected = space.vector(), found = space.vector();
    problem.whole.solve(space.constraints, expected);
    sweep.solve(space, found);
    CHECK(WholeAndCondensed::distance(expected, found) < single_round_off);

    problem.whole.right_hand_side = 0;
    problem.on_own_cells([&](const auto& cell, const auto& indices) {
        const auto rhs = problem.cell_right_hand_side(cell, 0.4);
        sweep.set(cell, rhs);
        space.constraints.distribute_local_to_global(rhs, indices, problem.whole.right_hand_side);
    });
    problem.whole.apply_factors(space.constraints, expected);
    sweep.apply_factors(space, found);
    CHECK(WholeAndCondensed::distance(expected, found) < single_round_off);
}

TEST_CASE("a condensed system survives singular and not finite matrices", "[condensation]") {
    WholeAndCondensed problem(MPI_COMM_SELF, true);
    CHECK(failure(problem, 0) == "linear-solver");
    CHECK(failure(problem, std::nan("")) == "not-a-number");
    CHECK(failure(problem, INFINITY) == "not-a-number");
    CHECK(problem.difference() < single_round_off);  // as if nothing had happened
}

TEST_CASE("few and many unknowns between processes have the same solution", "[condensation][mpi]") {
    for (const unsigned int count : {4U, 400U}) {
        CAPTURE(count);
        InterfaceSystem few(MPI_COMM_WORLD, "few"), many(MPI_COMM_WORLD, "many", 0);
        const auto expected = shared_solution(few, count);
        auto found = shared_solution(many, count);
        found -= expected;
        CHECK(found.linfty_norm() < 1e-13 * expected.linfty_norm());
    }
}
