#include "phasefield/solver/block_gauss_seidel.h"

#include <utility>

namespace endoflow::phasefield {

namespace {

void take_out(const dealii::FullMatrix<double>& matrix, const std::vector<unsigned int>& rows,
              const std::vector<unsigned int>& columns, dealii::LAPACKFullMatrix<float>& out) {
    for (unsigned int i = 0; i < rows.size(); ++i)
        for (unsigned int k = 0; k < columns.size(); ++k) out(i, k) = static_cast<float>(matrix(rows[i], columns[k]));
}

}  // namespace

BlockGaussSeidel::BlockGaussSeidel(MPI_Comm communicator, const std::string& name, std::vector<unsigned int> first,
                                   std::vector<unsigned int> second)
    : one_{std::move(first), {}, {}},
      two_{std::move(second), {}, {}},
      first_(communicator, name, one_.components),
      second_(communicator, name, two_.components) {}

void BlockGaussSeidel::reinit(const Space& space) {
    first_.reinit(space);
    second_.reinit(space);
    for (Block* block : {&one_, &two_}) {
        auto& in_cell = block->in_cell;
        in_cell.clear();
        for (const unsigned int component : block->components)
            in_cell.insert(in_cell.end(), space.local[component].begin(), space.local[component].end());
        block->values.reinit(static_cast<unsigned int>(in_cell.size()));
    }
    const unsigned int n_1 = one_.values.size(), n_2 = two_.values.size();
    cell_values_.reinit(n_1 + n_2);
    cells_.clear();
    positions_.assign(space.dofs.get_triangulation().n_active_cells(), 0);
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        positions_[cell->active_cell_index()] = cells_.size();
        Coupling& kept = cells_.emplace_back();
        kept.A_12.reinit(n_1, n_2);
        kept.A_21.reinit(n_2, n_1);
    }
}

void BlockGaussSeidel::start() {
    first_.start();
    second_.start();
}

void BlockGaussSeidel::start_right_hand_side() {
    first_.start_right_hand_side();
}

void BlockGaussSeidel::add(const Cell& cell, const dealii::FullMatrix<double>& matrix,
                           const dealii::Vector<double>& right_hand_side) {
    first_.add(cell, matrix);
    second_.add(cell, matrix);
    Coupling& kept = cells_[positions_[cell->active_cell_index()]];
    take_out(matrix, one_.in_cell, two_.in_cell, kept.A_12);
    take_out(matrix, two_.in_cell, one_.in_cell, kept.A_21);
    second_.add(cell, right_hand_side);
    kept.residual = right_hand_side;
}

void BlockGaussSeidel::add(const Cell& cell, const dealii::Vector<double>& right_hand_side) {
    first_.add(cell, right_hand_side);
    cells_[positions_[cell->active_cell_index()]].residual = right_hand_side;
}

void BlockGaussSeidel::use(Precision precision) {
    first_.use(precision);
    second_.use(precision);
}

void BlockGaussSeidel::forget_factors() {
    first_.forget_factors();
    second_.forget_factors();
}

void BlockGaussSeidel::hand_over(const Space& space, const Vector& solution, Block& from, Block& to,
                                 dealii::LAPACKFullMatrix<float> Coupling::*coupling, CondensedSystem& system) {
    system.start_right_hand_side();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const Coupling& kept = cells_[positions_[cell->active_cell_index()]];
        cell->get_dof_values(solution, cell_values_);
        for (unsigned int k = 0; k < from.values.size(); ++k)
            from.values(k) = static_cast<float>(cell_values_(from.in_cell[k]));
        (kept.*coupling).vmult(to.values, from.values);
        cell_values_ = kept.residual;
        for (unsigned int i = 0; i < to.values.size(); ++i) cell_values_(to.in_cell[i]) -= to.values(i);
        system.add(cell, cell_values_);
    }
}

void BlockGaussSeidel::solve(const Space& space, Vector& solution) {
    second_.solve(space, solution);
    hand_over(space, solution, two_, one_, &Coupling::A_12, first_);
    first_.solve(space, solution);
    hand_over(space, solution, one_, two_, &Coupling::A_21, second_);
    second_.apply_factors(space, solution);
}

void BlockGaussSeidel::apply_factors(const Space& space, Vector& solution) {
    first_.apply_factors(space, solution);
    hand_over(space, solution, one_, two_, &Coupling::A_21, second_);
    second_.apply_factors(space, solution);
}

}  // namespace endoflow::phasefield
