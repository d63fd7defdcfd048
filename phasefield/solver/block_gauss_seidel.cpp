#include "phasefield/solver/block_gauss_seidel.h"

#include <algorithm>

namespace endoflow::phasefield {

BlockGaussSeidel::BlockGaussSeidel(MPI_Comm communicator, const std::string& name,
                                   const std::vector<std::vector<unsigned int>>& blocks) {
    for (const auto& components : blocks) blocks_.emplace_back(communicator, name, components);
}

void BlockGaussSeidel::reinit(const Space& space, const std::vector<unsigned int>& process) {
    std::vector<unsigned int> earlier;
    for (Block& block : blocks_) {
        block.system.reinit(space, process);
        block.earlier = earlier;
        block.coupling.clear();
        const auto& in_cell = block.system.in_cell();
        const auto rows = static_cast<unsigned int>(in_cell.size()),
                   columns = static_cast<unsigned int>(earlier.size());
        if (columns > 0)
            block.coupling.assign(block.system.own_cells(), dealii::LAPACKFullMatrix<float>(rows, columns));
        for (const unsigned int component : block.system.components())
            earlier.insert(earlier.end(), space.local[component].begin(), space.local[component].end());
    }
    residuals_.assign(blocks_.front().system.own_cells(), dealii::Vector<double>(space.element.n_dofs_per_cell()));
}

void BlockGaussSeidel::set(const Cell& cell, const dealii::FullMatrix<double>& matrix,
                           const dealii::Vector<double>& right_hand_side) {
    for (Block& block : blocks_) {
        block.system.set(cell, matrix);
        if (block.earlier.empty()) continue;
        auto& A = block.coupling[position(cell)];
        const auto& in_cell = block.system.in_cell();
        for (unsigned int i = 0; i < in_cell.size(); ++i)
            for (unsigned int k = 0; k < block.earlier.size(); ++k)
                A(i, k) = static_cast<float>(matrix(in_cell[i], block.earlier[k]));
    }
    set(cell, right_hand_side);
}

void BlockGaussSeidel::set(const Cell& cell, const dealii::Vector<double>& right_hand_side) {
    blocks_.front().system.set(cell, right_hand_side);
    residuals_[position(cell)] = right_hand_side;
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

double BlockGaussSeidel::operations() const {
    double sum = 0;
    for (const Block& block : blocks_) sum += block.system.operations();
    return sum;
}

CondensedSystem::Index BlockGaussSeidel::shared_unknowns() const {
    CondensedSystem::Index sum = 0;
    for (const Block& block : blocks_) sum += block.system.shared_unknowns();
    return sum;
}

void BlockGaussSeidel::hand_over(const Space& space, const Vector& solution, Block& block) {
    if (block.earlier.empty()) return;
    const auto& in_cell = block.system.in_cell();
    dealii::Vector<double> of_cell(space.element.n_dofs_per_cell());
    dealii::Vector<float> before(static_cast<unsigned int>(block.earlier.size())),
        part(static_cast<unsigned int>(in_cell.size()));
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const std::size_t own = position(cell);
        cell->get_dof_values(solution, of_cell);
        for (unsigned int k = 0; k < before.size(); ++k) before(k) = static_cast<float>(of_cell(block.earlier[k]));
        block.coupling[own].vmult(part, before);
        for (unsigned int i = 0; i < part.size(); ++i) residuals_[own](in_cell[i]) -= part(i);
        block.system.set(cell, residuals_[own]);
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
