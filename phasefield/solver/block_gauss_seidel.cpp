#include "phasefield/solver/block_gauss_seidel.h"

#include <algorithm>

namespace endoflow::phasefield {

BlockGaussSeidel::BlockGaussSeidel(MPI_Comm communicator, const std::string& name,
                                   const std::vector<std::vector<unsigned int>>& blocks) {
    for (const auto& components : blocks) blocks_.emplace_back(communicator, name, components);
}

void BlockGaussSeidel::reinit(const Space& space) {
    std::vector<unsigned int> earlier;
    for (Block& block : blocks_) {
        block.system.reinit(space);
        block.earlier = earlier;
        block.in_cell.clear();
        for (const unsigned int component : block.components)
            block.in_cell.insert(block.in_cell.end(), space.local[component].begin(), space.local[component].end());
        block.coupling.clear();
        earlier.insert(earlier.end(), block.in_cell.begin(), block.in_cell.end());
    }
    positions_.assign(space.dofs.get_triangulation().n_active_cells(), 0);
    std::size_t own = 0;
    for (const auto& cell : space.dofs.active_cell_iterators())
        if (cell->is_locally_owned()) positions_[cell->active_cell_index()] = own++;
    residuals_.assign(own, dealii::Vector<double>(space.element.n_dofs_per_cell()));
    for (Block& block : blocks_) {
        const auto rows = static_cast<unsigned int>(block.in_cell.size()),
                   columns = static_cast<unsigned int>(block.earlier.size());
        if (columns > 0) block.coupling.assign(own, dealii::LAPACKFullMatrix<float>(rows, columns));
    }
}

void BlockGaussSeidel::start() {
    for (Block& block : blocks_) block.system.start();
}

void BlockGaussSeidel::start_right_hand_side() {
    blocks_.front().system.start_right_hand_side();
}

void BlockGaussSeidel::add(const Cell& cell, const dealii::FullMatrix<double>& matrix,
                           const dealii::Vector<double>& right_hand_side) {
    for (Block& block : blocks_) {
        block.system.add(cell, matrix);
        if (block.earlier.empty()) continue;
        auto& A = block.coupling[positions_[cell->active_cell_index()]];
        for (unsigned int i = 0; i < block.in_cell.size(); ++i)
            for (unsigned int k = 0; k < block.earlier.size(); ++k)
                A(i, k) = static_cast<float>(matrix(block.in_cell[i], block.earlier[k]));
    }
    add(cell, right_hand_side);
}

void BlockGaussSeidel::add(const Cell& cell, const dealii::Vector<double>& right_hand_side) {
    blocks_.front().system.add(cell, right_hand_side);
    residuals_[positions_[cell->active_cell_index()]] = right_hand_side;
}

void BlockGaussSeidel::use(Precision precision) {
    for (Block& block : blocks_) block.system.use(precision);
}

void BlockGaussSeidel::forget_factors() {
    for (Block& block : blocks_) block.system.forget_factors();
}

bool BlockGaussSeidel::has_factors() const {
    return std::all_of(blocks_.begin(), blocks_.end(), [](const Block& block) { return block.system.has_factors(); });
}

SubdomainSystem::Index BlockGaussSeidel::shared_unknowns() const {
    SubdomainSystem::Index sum = 0;
    for (const Block& block : blocks_) sum += block.system.shared_unknowns();
    return sum;
}

void BlockGaussSeidel::hand_over(const Space& space, const Vector& solution, Block& block) {
    if (block.earlier.empty()) return;
    dealii::Vector<double> of_cell(space.element.n_dofs_per_cell());
    dealii::Vector<float> before(static_cast<unsigned int>(block.earlier.size())),
        part(static_cast<unsigned int>(block.in_cell.size()));
    block.system.start_right_hand_side();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const std::size_t position = positions_[cell->active_cell_index()];
        cell->get_dof_values(solution, of_cell);
        for (unsigned int k = 0; k < before.size(); ++k) before(k) = static_cast<float>(of_cell(block.earlier[k]));
        block.coupling[position].vmult(part, before);
        for (unsigned int i = 0; i < part.size(); ++i) residuals_[position](block.in_cell[i]) -= part(i);
        block.system.add(cell, residuals_[position]);
    }
}

void BlockGaussSeidel::solve(const Space& space, Vector& solution) {
    for (Block& block : blocks_) {
        hand_over(space, solution, block);
        block.system.solve(space, solution);
    }
}

void BlockGaussSeidel::apply_factors(const Space& space, Vector& solution) {
    for (Block& block : blocks_) {
        hand_over(space, solution, block);
        block.system.apply_factors(space, solution);
    }
}

}  // namespace endoflow::phasefield
