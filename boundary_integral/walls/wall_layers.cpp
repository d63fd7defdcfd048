#include "boundary_integral/walls/wall_layers.h"

namespace endoflow::boundary_integral {

std::vector<LayerColumns> wall_columns(std::size_t components, RowMatrix& matrix) {
    const auto stride = static_cast<Index>(components);
    const std::size_t axial = components - 1;
    std::vector<LayerColumns> columns = {
        {Layer::doubled, axial, vertical_table, &matrix, stride - 1, stride},
        {Layer::single, axial, traction_table, &matrix, stride - 1, stride, -1.0},
    };
    for (std::size_t j = 0; j < axial; ++j)
        columns.push_back({Layer::doubled, j, lateral_table, &matrix, static_cast<Index>(j), stride});
    return columns;
}

RowMatrix wall_layers(const WallPanels& walls, const std::vector<LayerTarget>& targets, Index rows, int threads) {
    RowMatrix matrix = RowMatrix::Zero(rows, walls.unknowns());
    const WallSurface surface(walls, WallQuadrature{});
    add_layers(surface, targets, {wall_columns(2, matrix)}, threads, [] { return AxisymmetricKernels(); });
    return matrix;
}

}  // namespace endoflow::boundary_integral
