#include "boundary_integral/operators/layer_matrices.h"

namespace endoflow::boundary_integral {

void LayerSums::add(const LayerColumns& columns, const std::vector<double>& kernel, Index row) {
    for (std::size_t group = 0; group < points_->basis[columns.table].groups(); ++group) {
        entries_[count_++] = {&columns, group, kernel.data(), row};
        if (count_ == entries_.size()) finish();
    }
}

void LayerSums::finish() {
    if (count_ == 0) return;
    const std::size_t pieces = at(points_->pieces), per_piece = points_->measure.size() / pieces;
    std::array<PointSum, 4> four;
    for (std::size_t k = 0; k < four.size(); ++k) {
        const Entry& entry = entries_[k < count_ ? k : 0];  // what is missing of four is summed in vain
        const BasisTable& table = points_->basis[entry.columns->table];
        sums_[k].resize(basis_stride * pieces);
        four[k] = {table.values(entry.group), table.width(), entry.kernel, sums_[k].data()};
    }
    point_sums(pieces, per_piece, points_->measure.data(), four);
    // Pieces side by side share entries of a row: one row after the other would wait for its own sums.
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        for (std::size_t k = 0; k < count_; ++k) {
            const auto& [columns, group, kernel, row] = entries_[k];
            double* begin = columns->matrix->row(row).data() + columns->first;
            points_->basis[columns->table].scatter(piece, group, &sums_[k][basis_stride * piece], columns->factor,
                                                   begin, columns->stride);
        }
    }
    count_ = 0;
}

}  // namespace endoflow::boundary_integral
