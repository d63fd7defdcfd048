#include "boundary_integral/support/parallel.h"
#include "boundary_integral/walls/panel_rule.h"
#include "boundary_integral/walls/wall_panels.h"

namespace endoflow::boundary_integral {

namespace {

/// The wall-wall block is built once and decides the balance of forces (1e-13): it gets the finer rule. Targets on the
/// moving membrane see the walls through the coarser one.
constexpr int wall_points = 40;
constexpr int membrane_points = 32;

class WallLayerBuilder {
  public:
    WallLayerBuilder(const WallPanels& walls, const QuadratureRule& wall_rule, const QuadratureRule& membrane_rule,
                     RowMatrix& matrix)
        : walls_(walls), wall_rule_(wall_rule), membrane_rule_(membrane_rule), matrix_(matrix) {}

    void add(const WallTarget& target) {
        for (const WallPanel& panel : walls_.panels()) add_panel(target, panel);
    }

  private:
    const WallPanels& walls_;
    const QuadratureRule& wall_rule_;
    const QuadratureRule& membrane_rule_;
    RowMatrix& matrix_;
    RingSources sources_;
    RingKernels kernels_;

    void add_panel(const WallTarget& target, const WallPanel& panel) {
        const QuadratureRule& base = target.node >= 0 ? wall_rule_ : membrane_rule_;
        if (const auto rule = panel_rule(walls_, panel, target.at, target.node, base)) {
            add_points(target, panel, *rule);
        } else {
            add_nodes(target, panel);
        }
    }

    /// The normal offset is constant on a straight segment, exactly zero on the target's own line.
    void push(const WallTarget& target, const WallSegment& segment, double r, double delta_r, double delta_z) {
        sources_.radius.push_back(r);
        sources_.delta_r.push_back(delta_r);
        sources_.delta_z.push_back(delta_z);
        sources_.normal_r.push_back(segment.normal_r);
        sources_.normal_offset.push_back(segment.normal_offset(target.at));
    }

    void add_nodes(const WallTarget& target, const WallPanel& panel) {
        const WallSegment& segment = walls_.segments()[panel.segment];
        const std::size_t count = walls_.rule().nodes.size();
        sources_.resize(0);
        for (std::size_t i = 0; i < count; ++i) {
            const WallNode& node = walls_.nodes()[at(panel.first_node) + i];
            push(target, segment, node.r, node.r - target.at.r, node.z - target.at.z);
        }
        evaluate_ring_kernels(target.at.r, sources_, kernels_);
        for (std::size_t i = 0; i < count; ++i) {
            const WallNode& node = walls_.nodes()[at(panel.first_node) + i];
            deposit(target, segment, panel.first_node + static_cast<Index>(i), i, node.weight * node.r * node.speed,
                    node.weight * node.r);
        }
    }

    void add_points(const WallTarget& target, const WallPanel& panel, const OffsetRule& rule) {
        const WallSegment& segment = walls_.segments()[panel.segment];
        const std::vector<PanelPoint> points = points_on_panel(walls_, panel, target.at, target.node, rule);
        sources_.resize(0);
        for (const PanelPoint& point : points) push(target, segment, point.r, point.delta_r, point.delta_z);
        evaluate_ring_kernels(target.at.r, sources_, kernels_);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::vector<double> shape = walls_.lagrange(panel, points[i].tau);
            for (std::size_t j = 0; j < shape.size(); ++j) {
                const double weight = points[i].weight * points[i].r * shape[j];
                deposit(target, segment, panel.first_node + static_cast<Index>(j), i, weight * points[i].speed, weight);
            }
        }
    }

    /// area = r ds, line = r dτ: the band's unknown t_z ds/dτ carries its own Jacobian.
    void deposit(const WallTarget& target, const WallSegment& segment, Index node, std::size_t i, double area,
                 double line) {
        const auto into = [&](Index row, double t_r, double t_z, double g_z) {
            if (row < 0) return;
            matrix_(row, 2 * node) += segment.viscosity * area * t_r;
            matrix_(row, 2 * node + 1) += segment.kind == WallKind::free ? segment.viscosity * area * t_z : -line * g_z;
        };
        into(target.rows.radial, kernels_.t_rr[i], kernels_.t_rz[i], kernels_.g_rz[i]);
        into(target.rows.axial, kernels_.t_zr[i], kernels_.t_zz[i], kernels_.g_zz[i]);
    }
};

}  // namespace

RowMatrix wall_layers(const WallPanels& walls, const std::vector<WallTarget>& targets, Index rows, int threads) {
    RowMatrix matrix = RowMatrix::Zero(rows, walls.unknowns());
    const QuadratureRule wall_rule = gauss_legendre(wall_points), membrane_rule = gauss_legendre(membrane_points);
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), threads, [&](Index begin, Index end) {
        WallLayerBuilder builder(walls, wall_rule, membrane_rule, matrix);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)]);
    });
    return matrix;
}

}  // namespace endoflow::boundary_integral
