#include "boundary_integral/modes/mode_walls.h"

#include <numbers>
#include <utility>

#include "boundary_integral/modes/azimuthal_kernels.h"
#include "boundary_integral/walls/wall_layers.h"

namespace endoflow::boundary_integral {

Index mode_wall_unknowns(const WallPanels& walls, int mode) {
    return 3 * static_cast<Index>(walls.nodes().size()) + (mode == 1 ? 1 : 0);
}

std::vector<LayerTarget> mode_wall_targets(const WallPanels& walls) {
    std::vector<LayerTarget> targets;
    for (const WallNode& node : walls.nodes()) {
        const auto i = static_cast<Index>(targets.size());
        targets.push_back({{node.r, node.z}, mode_rows(i), -1.0, i});
    }
    return targets;
}

std::vector<RowMatrix> mode_wall_layers(const WallPanels& walls, const std::vector<LayerTarget>& targets,
                                        int highest_mode, int threads) {
    const Index rows = 3 * static_cast<Index>(targets.size());
    std::vector<RowMatrix> matrices(static_cast<std::size_t>(highest_mode) + 1);
    std::vector<std::vector<LayerColumns>> columns;
    for (int mode = 0; mode <= highest_mode; ++mode) {
        RowMatrix& matrix = matrices[static_cast<std::size_t>(mode)];
        matrix = RowMatrix::Zero(rows, mode_wall_unknowns(walls, mode));
        columns.push_back(wall_columns(3, matrix));
        if (mode != 1) continue;
        // e_x = e_r cos phi - e_phi sin phi
        const Index held = matrix.cols() - 1;
        columns.back().push_back({Layer::single, radial_component, frame_table, &matrix, held, 1, -1.0});
        columns.back().push_back({Layer::single, azimuthal_component, frame_table, &matrix, held, 1, 1.0});
    }
    WallQuadrature quadrature;
    quadrature.points_of_nodes = quadrature.points;
    add_layers(WallSurface(walls, quadrature), targets, columns, threads,
               [&] { return AzimuthalKernels(highest_mode); });
    return matrices;
}

namespace {

// int u_x dS/pi over the band, u_x = u_r cos^2 phi - u_phi sin^2 phi.
Eigen::RowVectorXd held_row(const WallPanels& walls) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(mode_wall_unknowns(walls, 1));
    for (std::size_t i = 0; i < walls.nodes().size(); ++i) {
        const WallNode& node = walls.nodes()[i];
        if (!walls.is_band(node)) continue;
        const double measure = node.weight * node.speed * node.r;
        row[3 * static_cast<Index>(i)] = measure;
        row[3 * static_cast<Index>(i) + 1] = -measure;
    }
    return row;
}

}  // namespace

std::vector<LuFactors> mode_wall_factors(const WallPanels& walls, int highest_mode, int threads) {
    const auto& nodes = walls.nodes();
    const std::vector<RowMatrix> layers = mode_wall_layers(walls, mode_wall_targets(walls), highest_mode, threads);
    std::vector<LuFactors> factors;
    for (int mode = 0; mode <= highest_mode; ++mode) {
        const Index unknowns = mode_wall_unknowns(walls, mode);
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
        matrix.topRows(3 * static_cast<Index>(nodes.size())) = layers[static_cast<std::size_t>(mode)];
        if (mode == 1) matrix.bottomRows(1) = held_row(walls);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const Index first = 3 * static_cast<Index>(i);
            const double own = 4.0 * std::numbers::pi * walls.segments()[nodes[i].segment].viscosity;
            matrix(first, first) += own;
            matrix(first + 1, first + 1) += own;
            if (!walls.is_band(nodes[i])) matrix(first + 2, first + 2) += own;
            // Axisymmetric flow without swirl: u_phi = 0, and the box may turn about its axis.
            if (mode == 0) {
                matrix.row(first + 1).setZero();
                matrix(first + 1, first + 1) = own;
            }
        }
        factors.emplace_back(std::move(matrix), "wall");
    }
    return factors;
}

}  // namespace endoflow::boundary_integral
