#include "boundary_integral/flow/box_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

constexpr int nodes_per_wall_panel = 10;
constexpr double pi = std::numbers::pi;

int thread_count(int wanted) {
    return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// u(x0) itself at the targets: rows x curve_count.
RowMatrix evaluation_rows(const MembraneSpace& space) {
    RowMatrix matrix = RowMatrix::Zero(space.curve_count() - 2, space.curve_count());
    Index row = 0;
    const auto add = [&](const SplineSpace& spline, double xi, Index offset) {
        const BasisRow basis = spline.basis(xi);
        for (std::size_t j = 0; j < static_cast<std::size_t>(basis.count); ++j) {
            matrix(row, offset + basis.index[j]) += basis.value[0][j];
        }
        ++row;
    };
    for (double xi : space.radial_targets) add(space.radial(), xi, 0);
    for (double xi : space.axial_targets) add(space.axial(), xi, space.radial_count());
    return matrix;
}

struct CollocationTargets {
    std::vector<MembraneTarget> on_membrane;
    std::vector<WallTarget> seen_by_walls;
};

CollocationTargets collocation_targets(const MembraneSpace& space, const MembraneState& state) {
    CollocationTargets targets;
    const auto add = [&](double xi, TargetRows rows) {
        const CurvePoint p = curve_point(space.radial().basis(xi), space.axial().basis(xi), state);
        targets.on_membrane.push_back({{p.r, p.z}, rows, xi});
        targets.seen_by_walls.push_back({{p.r, p.z}, rows, -1});
    };
    // Both lists come from the same Greville points except for the axis and the rim: merge equal parameters.
    std::size_t axial = 0;
    const Index offset = space.radial_count();
    for (std::size_t i = 0; i < space.radial_targets.size(); ++i) {
        const double xi = space.radial_targets[i];
        while (axial < space.axial_targets.size() && space.axial_targets[axial] < xi - 1e-12) {
            add(space.axial_targets[axial], {-1, offset + static_cast<Index>(axial)});
            ++axial;
        }
        Index axial_row = -1;
        if (axial < space.axial_targets.size() && space.axial_targets[axial] <= xi + 1e-12) {
            axial_row = offset + static_cast<Index>(axial);
            ++axial;
        }
        add(xi, {static_cast<Index>(i), axial_row});
    }
    return targets;
}

}  // namespace

ClampedVelocities::ClampedVelocities(const MembraneSpace& space, const MembraneState& state)
    : radial_count(space.radial_count()), axial_count(space.axial_count()) {
    const BasisRow axial = space.axial().basis(1.0);
    const CurvePoint rim = curve_point(space.radial().basis(1.0), axial, state);
    double slope_of_function = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
        if (axial.index[j] == axial_count - 2) slope_of_function += axial.value[1][j];
    }
    slope_factor = rim.z2 / rim.g / slope_of_function;
}

Eigen::VectorXd ClampedVelocities::expand(const Eigen::VectorXd& values) const {
    Eigen::VectorXd full = Eigen::VectorXd::Zero(radial_count + axial_count);
    full.head(freedoms()) = values;
    full[radial_count + axial_count - 2] = slope_factor * values[radial_count - 1];
    return full;
}

Eigen::MatrixXd ClampedVelocities::restrict_columns(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd result = matrix.leftCols(freedoms());
    result.col(radial_count - 1) += slope_factor * matrix.col(radial_count + axial_count - 2);
    return result;
}

Eigen::MatrixXd ClampedVelocities::restrict_rows(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd result = matrix.topRows(freedoms());
    result.row(radial_count - 1) += slope_factor * matrix.row(radial_count + axial_count - 2);
    return result;
}

BoxFlow::BoxFlow(const Parameters& parameters, const MembraneSpace& space)
    : space_(space),
      walls_(parameters.domain, parameters.fluid, nodes_per_wall_panel),
      viscosity_below_(parameters.fluid.viscosity_extracellular),
      viscosity_above_(parameters.fluid.viscosity_intracellular),
      inextensible_(parameters.membrane.inextensible),
      threads_(thread_count(parameters.boundary_integral.threads)) {
    const auto& nodes = walls_.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Index node = static_cast<Index>(i);
        wall_targets_.push_back({{nodes[i].r, nodes[i].z}, {2 * node, 2 * node + 1}, node});
        wall_as_membrane_targets_.push_back({{nodes[i].r, nodes[i].z}, {2 * node, 2 * node + 1}, -1.0});
    }
    RowMatrix matrix = wall_layers(walls_, wall_targets_, walls_.unknowns());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Index node = static_cast<Index>(i);
        const double own = 4.0 * pi * walls_.segments()[nodes[i].segment].viscosity;
        matrix(2 * node, 2 * node) += own;
        if (!walls_.is_band(nodes[i])) matrix(2 * node + 1, 2 * node + 1) += own;
    }
    wall_factors_.emplace(Eigen::MatrixXd(matrix), "wall");
}

//   4 pi (nu1 + nu2) u + (nu1 - nu2) D u + W v = S f                  on the membrane
//   (nu1 - nu2) D_w u + A_w v = S_w f                                 on the walls; v is eliminated
MobilityOperators BoxFlow::operators(const MembraneState& state, const MembraneSamples& samples) const {
    const Index rows = space_.curve_count() - 2;
    const double contrast = viscosity_below_ - viscosity_above_;
    const CollocationTargets targets = collocation_targets(space_, state);
    LayerQuadrature quadrature;
    quadrature.threads = threads_;
    const MembraneLayers own = membrane_layers(space_, state, samples, targets.on_membrane, rows, quadrature);
    MembraneLayers at_walls =
        membrane_layers(space_, state, samples, wall_as_membrane_targets_, walls_.unknowns(), quadrature);
    const RowMatrix from_walls = wall_layers(walls_, targets.seen_by_walls, rows);

    // Z^T = A_w^-T W^T: one wall solve per membrane row serves both right-hand sides. The rows are independent of each
    // other.
    Eigen::MatrixXd velocity_matrix =
        4.0 * pi * (viscosity_below_ + viscosity_above_) * evaluation_rows(space_) + contrast * own.doubled;
    Eigen::MatrixXd force_matrix = own.single;
    parallel_parts(rows, threads_, [&](Index begin, Index end) {
        const Index count = end - begin;
        const Eigen::MatrixXd response =
            wall_factors_->solve_transposed(from_walls.middleRows(begin, count).transpose());
        velocity_matrix.middleRows(begin, count).noalias() -= contrast * (response.transpose() * at_walls.doubled);
        force_matrix.middleRows(begin, count).noalias() -= response.transpose() * at_walls.single;
    });

    MobilityOperators result{ClampedVelocities(space_, state), {}, {}, {}, {}};
    const LuFactors velocity_factors(result.clamped.restrict_columns(velocity_matrix), "velocity");
    const LuFactors mass(result.clamped.restrict_rows(force_mass_matrix(space_, samples)), "force mass");
    result.force_from_load = mass.solve(Eigen::MatrixXd::Identity(rows, rows));
    result.mobility = velocity_factors.solve(force_matrix * result.force_from_load);
    result.wall_from_force = std::move(at_walls.single);
    result.wall_from_velocity = -contrast * at_walls.doubled;
    return result;
}

FlowSolution BoxFlow::solve(const MobilityOperators& operators, const MembraneSamples& samples,
                            const EnergyDerivatives& energy, double rim_energy_density) const {
    FlowSolution flow;
    // <f, w> = -dE(w) - int lambda div_Gamma w for all w in W. Membrane that flows in through the rim is no change of
    // energy: its tangential motion carries the rim's energy density along, which dE counts as growth.
    Eigen::VectorXd gradient = operators.clamped.restrict_rows(energy.gradient);
    gradient[space_.radial_count() - 1] -= samples.rim_radius * rim_energy_density;
    flow.load = -gradient;
    if (inextensible_) {
        const Eigen::MatrixXd divergence = operators.clamped.restrict_columns(divergence_matrix(space_, samples));
        const Eigen::MatrixXd response = operators.mobility * divergence.transpose();
        const LuFactors schur(divergence * response, "tension");
        flow.tension = schur.solve(divergence * (operators.mobility * flow.load));
        flow.load -= divergence.transpose() * flow.tension;
    } else {
        flow.tension = Eigen::VectorXd::Zero(space_.tension().dimension());
    }
    flow.force = operators.force_from_load * flow.load;
    const Eigen::VectorXd freedoms = operators.mobility * flow.load;
    flow.velocity = operators.clamped.expand(freedoms);
    flow.inflow = freedoms[space_.radial_count() - 1];
    return flow;
}

Eigen::VectorXd BoxFlow::wall_unknowns(const MobilityOperators& operators, const FlowSolution& flow) const {
    return wall_factors_->solve(operators.wall_from_force * flow.force + operators.wall_from_velocity * flow.velocity);
}

FlowBalances flow_balances(const MembraneSpace& space, const BoxFlow& box, const MembraneSamples& samples,
                           const FlowSolution& flow, const Eigen::VectorXd& wall_unknowns) {
    FlowBalances balances{};
    double membrane_force = 0.0, membrane_modulus = 0.0, band_force = 0.0, band_modulus = 0.0;
    double flux_up = 0.0, flux_modulus = 0.0, power = 0.0, area_growth = 0.0;
    const Index radial = space.radial_count();
    const Eigen::VectorXd f_r = flow.force.head(radial), f_z = flow.force.tail(space.force().dimension());
    const Eigen::VectorXd u_r = flow.velocity.head(radial), u_z = flow.velocity.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double area = space.weight[i] * p.r * p.g;
        const double force_r = space.radial_rows[i].evaluate(f_r), force_z = space.force_rows[i].evaluate(f_z);
        const double speed_r = space.radial_rows[i].evaluate(u_r), speed_z = space.axial_rows[i].evaluate(u_z);
        membrane_force += area * force_z;
        membrane_modulus += area * std::abs(force_z);
        const double normal_flux = area * (speed_r * p.normal_r + speed_z * p.normal_z);
        flux_up += normal_flux;
        flux_modulus += std::abs(normal_flux);
        power += area * (force_r * speed_r + force_z * speed_z);
        area_growth +=
            space.weight[i] *
            (speed_r * p.g +
             p.r / p.g * (p.r1 * space.radial_rows[i].evaluate(u_r, 1) + p.z1 * space.axial_rows[i].evaluate(u_z, 1)));
    }
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
    balances.force = std::abs(membrane_force + band_force) / (membrane_modulus + band_modulus + 1e-300);
    balances.net_flux = (std::abs(out_below + flux_up) + std::abs(out_above - flux_up)) / (flux_modulus + 1e-300);
    balances.area = std::abs(area_growth) / (std::abs(samples.rim_radius * flow.inflow) + 1e-300);
    balances.power_pN_nm_per_us = 2.0 * pi * power;
    return balances;
}

}  // namespace endoflow::boundary_integral
