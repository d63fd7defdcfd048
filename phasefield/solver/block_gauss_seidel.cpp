#include "phasefield/solver/block_gauss_seidel.h"

namespace endoflow::phasefield {

BlockGaussSeidel::BlockGaussSeidel(MPI_Comm communicator, const std::string& name, std::vector<unsigned int> first,
                                   std::vector<unsigned int> second)
    : components_{std::move(first), std::move(second)},
      first_(communicator, name, components_[0]),
      second_(communicator, name, components_[1]) {}

void BlockGaussSeidel::reinit(const Space& space) {
    first_.reinit(space);
    second_.reinit(space);
    for (const int block : {0, 1}) {
        in_cell_[block].clear();
        for (const unsigned int component : components_[block])
            in_cell_[block].insert(in_cell_[block].end(), space.local[component].begin(), space.local[component].end());
    }
    const auto n_1 = static_cast<unsigned int>(in_cell_[0].size()), n_2 = static_cast<unsigned int>(in_cell_[1].size());
    x_1_.reinit(n_1);
    change_.reinit(n_2);
    cells_.clear();
    positions_.assign(space.dofs.get_triangulation().n_active_cells(), 0);
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        positions_[cell->active_cell_index()] = cells_.size();
        Coupling& kept = cells_.emplace_back();
        kept.A_21.reinit(n_2, n_1);
        kept.residual.reinit(space.element.n_dofs_per_cell());
    }
}

void BlockGaussSeidel::start() {
    first_.start();
    second_.start();
}

void BlockGaussSeidel::start_right_hand_side() {
    first_.start_right_hand_side();
    second_.start_right_hand_side();
}

void BlockGaussSeidel::add(const Cell& cell, const dealii::FullMatrix<double>& matrix,
                           const dealii::Vector<double>& right_hand_side) {
    first_.add(cell, matrix);
    second_.add(cell, matrix);
    auto& A_21 = cells_[positions_[cell->active_cell_index()]].A_21;
    for (unsigned int i = 0; i < in_cell_[1].size(); ++i)
        for (unsigned int k = 0; k < in_cell_[0].size(); ++k)
            A_21(i, k) = static_cast<float>(matrix(in_cell_[1][i], in_cell_[0][k]));
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
    dealii::Vector<double> values(space.element.n_dofs_per_cell());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        cell->get_dof_values(solution, values);
        for (unsigned int k = 0; k < x_1_.size(); ++k) x_1_(k) = static_cast<float>(values(in_cell_[0][k]));
        Coupling& kept = cells_[positions_[cell->active_cell_index()]];
        kept.A_21.vmult(change_, x_1_);
        for (unsigned int i = 0; i < change_.size(); ++i) kept.residual(in_cell_[1][i]) -= change_(i);
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
