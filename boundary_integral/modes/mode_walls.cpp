#include "boundary_integral/modes/mode_walls.h"

#include <numbers>
#include <utility>

#include "boundary_integral/modes/azimuthal_kernels.h"
#include "boundary_integral/support/parallel.h"
#include "boundary_integral/walls/panel_rule.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int points_per_side = 32;

class ModeWallBuilder {
  public:
    ModeWallBuilder(const WallPanels& walls, const QuadratureRule& rule, std::vector<RowMatrix>& matrices)
        : walls_(walls), rule_(rule), matrices_(matrices), kernels_(static_cast<int>(matrices.size()) - 1) {}

    void add(const ModeWallTarget& target, Index first_row) {
        first_row_ = first_row;
        for (const WallPanel& panel : walls_.panels()) add_panel(target, panel);
    }

  private:
    const WallPanels& walls_;
    const QuadratureRule& rule_;
    std::vector<RowMatrix>& matrices_;
    AzimuthalKernels kernels_;
    Index first_row_ = 0;

    void add_panel(const ModeWallTarget& target, const WallPanel& panel) {
        if (const auto rule = panel_rule(walls_, panel, target.at, target.node, rule_)) {
            add_points(target, panel, *rule);
        } else {
            add_nodes(target, panel);
        }
    }

    // The normal offset is constant on a straight segment, exactly zero on the target's own line.
    static RingPair pair_of(const ModeWallTarget& target, const WallSegment& segment, double r, double dr, double dz) {
        return {target.at.r, r, dr, dz, segment.normal_r, segment.normal_offset(target.at)};
    }

    void add_nodes(const ModeWallTarget& target, const WallPanel& panel) {
        const WallSegment& segment = walls_.segments()[panel.segment];
        for (std::size_t i = 0; i < walls_.rule().nodes.size(); ++i) {
            const Index index = panel.first_node + static_cast<Index>(i);
            const WallNode& node = walls_.nodes()[at(index)];
            const auto& kernels =
                kernels_(pair_of(target, segment, node.r, node.r - target.at.r, node.z - target.at.z));
            deposit(kernels, segment, index, node.weight * node.r * node.speed, node.weight * node.r);
        }
    }

    void add_points(const ModeWallTarget& target, const WallPanel& panel, const OffsetRule& rule) {
        const WallSegment& segment = walls_.segments()[panel.segment];
        for (const PanelPoint& point : points_on_panel(walls_, panel, target.at, target.node, rule)) {
            const auto& kernels = kernels_(pair_of(target, segment, point.r, point.delta_r, point.delta_z));
            const std::vector<double> shape = walls_.lagrange(panel, point.tau);
            for (std::size_t j = 0; j < shape.size(); ++j) {
                const double weight = point.weight * point.r * shape[j];
                deposit(kernels, segment, panel.first_node + static_cast<Index>(j), weight * point.speed, weight);
            }
        }
    }

    // area = r ds, line = r d tau: the band's unknown t_z ds/d tau carries its own Jacobian.
    void deposit(const std::vector<ModeKernels>& kernels, const WallSegment& segment, Index node, double area,
                 double line) {
        const bool free = segment.kind == WallKind::free;
        const double factor = segment.viscosity * area;
        for (std::size_t mode = 0; mode < matrices_.size(); ++mode) {
            for (std::size_t i = 0; i < 3; ++i) {
                double* entries = matrices_[mode].row(first_row_ + static_cast<Index>(i)).data() + 3 * node;
                const auto& t = kernels[mode].doubled[i];
                entries[0] += factor * t[0];
                entries[1] += factor * t[1];
                entries[2] += free ? factor * t[2] : -line * kernels[mode].single[i][2];
                if (mode != 1 || free) continue;
                // e_x = e_r cos phi - e_phi sin phi
                const auto& g = kernels[mode].single[i];
                matrices_[mode](first_row_ + static_cast<Index>(i), matrices_[mode].cols() - 1) -= area * (g[0] - g[1]);
            }
        }
    }
};

}  // namespace

Index mode_wall_unknowns(const WallPanels& walls, int mode) {
    return 3 * static_cast<Index>(walls.nodes().size()) + (mode == 1 ? 1 : 0);
}

std::vector<RowMatrix> mode_wall_layers(const WallPanels& walls, const std::vector<ModeWallTarget>& targets,
                                        int highest_mode, int threads) {
    const Index rows = 3 * static_cast<Index>(targets.size());
    std::vector<RowMatrix> matrices;
    for (int mode = 0; mode <= highest_mode; ++mode) {
        matrices.push_back(RowMatrix::Zero(rows, mode_wall_unknowns(walls, mode)));
    }
    const QuadratureRule rule = gauss_legendre(points_per_side);
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), threads, [&](Index begin, Index end) {
        ModeWallBuilder builder(walls, rule, matrices);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)], 3 * i);
    });
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
    std::vector<ModeWallTarget> targets;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        targets.push_back({{nodes[i].r, nodes[i].z}, static_cast<Index>(i)});
    }
    const std::vector<RowMatrix> layers = mode_wall_layers(walls, targets, highest_mode, threads);
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
