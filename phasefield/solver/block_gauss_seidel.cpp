#include "phasefield/solver/block_gauss_seidel.h"

#include <utility>

namespace endoflow::phasefield {

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
    for (unsigned int i = 0; i < two_.in_cell.size(); ++i)
        for (unsigned int k = 0; k < one_.in_cell.size(); ++k)
            kept.A_21(i, k) = static_cast<float>(matrix(two_.in_cell[i], one_.in_cell[k]));
    add(cell, right_hand_side);
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

void BlockGaussSeidel::hand_over(const Space& space, const Vector& solution) {
    second_.start_right_hand_side();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        Coupling& kept = cells_[positions_[cell->active_cell_index()]];
        cell->get_dof_values(solution, cell_values_);
        for (unsigned int k = 0; k < one_.values.size(); ++k)
            one_.values(k) = static_cast<float>(cell_values_(one_.in_cell[k]));
        kept.A_21.vmult(two_.values, one_.values);
        for (unsigned int i = 0; i < two_.values.size(); ++i) kept.residual(two_.in_cell[i]) -= two_.values(i);
        second_.add(cell, kept.residual);
    }
}

void BlockGaussSeidel::solve(const Space& space, Vector& solution) {
    first_.solve(space, solution);
    hand_over(space, solution);
    second_.solve(space, solution);
}

void BlockGaussSeidel::apply_factors(const Space& space, Vector& solution) {
    first_.apply_factors(space, solution);
    hand_over(space, solution);
    second_.apply_factors(space, solution);
}

}  // namespace endoflow::phasefield
