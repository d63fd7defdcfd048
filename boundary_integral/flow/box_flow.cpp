#include "boundary_integral/flow/box_flow.h"

#include <cmath>
#include <numbers>

#include "boundary_integral/flow/membrane_fluxes.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {
constexpr Index elimination_blocks = 4;
}  // namespace

BoxFlow::BoxFlow(const Parameters& parameters, const MembraneSpace& space)
    : FlowModel(space, {parameters.membrane.inextensible, false}),
      collocation_(space, parameters.fluid),
      walls_(parameters.domain, parameters.fluid),
      threads_(thread_count(parameters.boundary_integral.threads)) {
    const auto& nodes = walls_.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Index node = static_cast<Index>(i);
        wall_targets_.push_back({{nodes[i].r, nodes[i].z}, {2 * node, 2 * node + 1}, -1.0, node});
    }
    RowMatrix matrix = wall_layers(walls_, wall_targets_, walls_.unknowns(), threads_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Index node = static_cast<Index>(i);
        const double own = 4.0 * std::numbers::pi * walls_.segments()[nodes[i].segment].viscosity;
        matrix(2 * node, 2 * node) += own;
        if (!walls_.is_band(nodes[i])) matrix(2 * node + 1, 2 * node + 1) += own;
    }
    wall_inverse_ = inverse(matrix, "wall");
}

///   4 π (ν₁ + ν₂) u + (ν₁ - ν₂) D u + W v = S f                  on the membrane
///   (ν₁ - ν₂) D_w u + A_w v = S_w f                                 on the walls; v is eliminated
MobilityOperators BoxFlow::operators(const MembraneState& state, const MembraneSamples& samples) const {
    const double contrast = collocation_.contrast();
    LayerQuadrature quadrature;
    quadrature.threads = threads_;
    const std::vector<LayerTarget> targets = collocation_.targets(state);
    MembraneCollocation::Equation equation = collocation_.equation(state, samples, targets, quadrature);
    MembraneLayers at_walls = membrane_layers(space(), state, samples, wall_targets_, walls_.unknowns(), quadrature);
    const RowMatrix from_walls = wall_layers(walls_, targets, collocation_.rows(), threads_);

    // The rows are independent of each other; they are cut into blocks that do not depend on the number of threads, so
    // that results do not either.
    const auto eliminate = [&](Index begin, Index end) {
        const Index count = end - begin;
        const RowMatrix response = from_walls.middleRows(begin, count) * wall_inverse_;
        equation.velocity.middleRows(begin, count).noalias() -= contrast * (response * at_walls.doubled);
        equation.force.middleRows(begin, count).noalias() -= response * at_walls.single;
    };
    const Index rows = collocation_.rows();
    parallel_parts(elimination_blocks, threads_, [&](Index first, Index last) {
        for (Index block = first; block < last; ++block) {
            eliminate(rows * block / elimination_blocks, rows * (block + 1) / elimination_blocks);
        }
    });

    MobilityOperators result;
    result.samples = samples;
    result.freedoms = VelocityFreedoms::with_inflow(space(), state);
    collocation_.solve(equation, result);
    result.wall_from_force = std::move(at_walls.single);
    result.wall_from_velocity = -contrast * at_walls.doubled;
    return result;
}

Eigen::VectorXd BoxFlow::wall_unknowns(const MobilityOperators& operators, const FlowSolution& flow) const {
    return wall_inverse_ * (operators.wall_from_force * flow.force + operators.wall_from_velocity * flow.velocity);
}

FlowBalances flow_balances(const MembraneSpace& space, const BoxFlow& box, const MobilityOperators& operators,
                           const MembraneSamples& samples, const FlowSolution& flow, const RestLevel& rest) {
    const Eigen::VectorXd wall_unknowns = box.wall_unknowns(operators, flow);
    const MembraneFluxes membrane = membrane_fluxes(space, operators.samples, flow);
    const double area_growth = membrane_fluxes(space, samples, flow).area_growth;
    double band_force = 0.0, band_modulus = 0.0;
    double out_below = 0.0, out_above = 0.0;
    const auto& nodes = box.walls().nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const WallNode& node = nodes[i];
        const WallSegment& segment = box.walls().segments()[node.segment];
        const bool band = box.walls().is_band(node);
        const double u_out = segment.normal_r * wall_unknowns[2 * static_cast<Index>(i)] +
                             (band ? 0.0 : segment.normal_z * wall_unknowns[2 * static_cast<Index>(i) + 1]);
        (node.segment < 3 ? out_below : out_above) += node.weight * node.speed * node.r * u_out;
        if (band) {
            const double traction = node.weight * node.r * wall_unknowns[2 * static_cast<Index>(i) + 1];
            band_force += traction;
            band_modulus += std::abs(traction);
        }
    }
    const double imbalance = std::abs(out_below + membrane.volume) + std::abs(out_above - membrane.volume);
    return {std::abs(membrane.force + band_force) / rest_floor(membrane.force_modulus + band_modulus, 0.0, rest.force),
            imbalance / rest_floor(membrane.volume_modulus, 0.0, rest.volume_rate()),
            std::abs(area_growth) / rest_floor(std::abs(samples.rim_radius * flow.inflow), 0.0, rest.area_rate())};
}

}  // namespace endoflow::boundary_integral
