#include "boundary_integral/modes/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/support/parallel.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double slack = 1e-12;  // in xi

std::vector<double> united(const std::vector<ModeSpace>& spaces) {
    std::vector<double> points;
    for (const ModeSpace& space : spaces) {
        for (const auto& of_component : space.targets()) {
            points.insert(points.end(), of_component.begin(), of_component.end());
        }
    }
    std::sort(points.begin(), points.end());
    const auto equal = [](double a, double b) { return std::abs(a - b) < slack; };
    points.erase(std::unique(points.begin(), points.end(), equal), points.end());
    return points;
}

}  // namespace

Surroundings::Surroundings(const Parameters& parameters, const MembraneSpace& space, int highest_mode)
    : membrane_(space),
      viscosities_{parameters.fluid.viscosity_extracellular, parameters.fluid.viscosity_intracellular},
      threads_(thread_count(parameters.boundary_integral.threads)),
      parities_(space) {
    if (parameters.fluid.dynamics != Dynamics::flow) {
        throw InputError("fluid.dynamics: azimuthal modes are those of a membrane in a fluid");
    }
    for (int mode = 0; mode <= highest_mode; ++mode) spaces_.emplace_back(space, parities_, mode);
    points_ = united(spaces_);
    if (parameters.domain.kind != DomainKind::box) return;
    walls_.emplace(parameters.domain, parameters.fluid);
    wall_factors_ = mode_wall_factors(*walls_, highest_mode, threads_);
}

Index Surroundings::point_index(double xi) const {
    return std::lower_bound(points_.begin(), points_.end(), xi - slack) - points_.begin();
}

// From (r, phi, z) rows at all points to the equations of one mode.
Eigen::MatrixXd Surroundings::equations(int mode, const RowMatrix& at_points) const {
    const ModeSpace& mode_space = space(mode);
    Index count = 0;
    for (const auto& points : mode_space.targets()) count += static_cast<Index>(points.size());
    Eigen::MatrixXd result(count, at_points.cols());
    Index row = 0;
    for (std::size_t k = 0; k < mode_space.targets().size(); ++k) {
        const VelocityComponent& component = mode_space.components()[k];
        for (const double xi : mode_space.targets()[k]) {
            const Index first = 3 * point_index(xi);
            result.row(row++) = component.radial * at_points.row(first) +
                                component.azimuthal * at_points.row(first + 1) +
                                component.axial * at_points.row(first + 2);
        }
    }
    return result;
}

Eigen::MatrixXd Surroundings::evaluation(int mode) const {
    const ModeSpace& mode_space = space(mode);
    const Index lateral = mode_space.lateral().dimension();
    RowMatrix values = RowMatrix::Zero(3 * static_cast<Index>(points_.size()), mode_space.velocity_count());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const BasisRow across = mode_space.lateral().basis(points_[i]);
        const BasisRow along = mode_space.vertical().basis(points_[i]);
        const Index row = 3 * static_cast<Index>(i);
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
            values(row, across.index[j]) += across.value[0][j];
            values(row + 1, lateral + across.index[j]) += across.value[0][j];
            values(row + 2, 2 * lateral + along.index[j]) += along.value[0][j];
        }
    }
    return equations(mode, values);
}

std::vector<LayerTarget> Surroundings::targets(const MembraneState& state) const {
    std::vector<LayerTarget> result;
    for (const double xi : points_) {
        const CurvePoint p = curve_point(membrane_.radial().basis(xi), membrane_.axial().basis(xi), state);
        const bool on_axis = xi < slack || (membrane_.end() == CurveEnd::closed && xi > 1.0 - slack);
        result.push_back({{on_axis ? 0.0 : p.r, p.z}, mode_rows(static_cast<Index>(result.size())), xi});
    }
    return result;
}

Surroundings::Layers Surroundings::layers(const BaseState& base) const {
    const std::vector<LayerTarget> on_membrane = targets(base.membrane);
    const std::vector<ModeLayers> own =
        mode_layers(membrane_, parities_, base.membrane, on_membrane, highest_mode(), threads_);
    Layers result;
    for (int mode = 0; mode <= highest_mode(); ++mode) {
        const ModeLayers& layers = own[static_cast<std::size_t>(mode)];
        result.of_mode.push_back({equations(mode, layers.doubled), equations(mode, layers.single)});
    }
    if (!walls_) {
        result.traction_sum = traction_sum(base, result.of_mode[0], {});
        return result;
    }
    const std::vector<ModeLayers> at_walls =
        mode_layers(membrane_, parities_, base.membrane, mode_wall_targets(*walls_), highest_mode(), threads_);
    const std::vector<RowMatrix> from_walls = mode_wall_layers(*walls_, on_membrane, highest_mode(), threads_);
    result.traction_sum = traction_sum(base, result.of_mode[0], equations(0, from_walls[0]));
    for (int mode = 0; mode <= highest_mode(); ++mode) {
        const std::size_t m = static_cast<std::size_t>(mode);
        // v = A_w^-1 (S_w q - ...): one wall solve per equation of the membrane, see BoxFlow.
        const Eigen::MatrixXd response = wall_factors_[m].solve_transposed(equations(mode, from_walls[m]).transpose());
        const auto rows = response.topRows(at_walls[m].single.rows());  // without that of the held band
        result.of_mode[m].doubled.noalias() -= rows.transpose() * at_walls[m].doubled;
        result.of_mode[m].single.noalias() -= rows.transpose() * at_walls[m].single;
    }
    return result;
}

// One-sided tractions t_k = sigma_k.n from Green's identity in each fluid,
//     4 pi nu_1 u + nu_1 D u + W_1 v = S t_1,     4 pi nu_2 u - nu_2 D u + W_2 v = - S t_2,
// solved for t_1 + t_2; t_1 - t_2 = f is known. On a closed membrane a pressure is left open: S n = 0.
Eigen::VectorXd Surroundings::traction_sum(const BaseState& base, const CollocatedLayers& axisymmetric,
                                           const Eigen::MatrixXd& from_walls) const {
    const ModeSpace& mode_space = space(0);
    const Index radial = membrane_.radial_count(), force = membrane_.force().dimension();
    if (base.velocity.isZero(0.0) && base.force.isZero(0.0)) return Eigen::VectorXd::Zero(radial + force);
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(mode_space.velocity_count());
    velocity.head(radial) = base.velocity.head(radial);
    velocity.tail(membrane_.axial_count()) = base.velocity.tail(membrane_.axial_count());
    Eigen::VectorXd right = 4.0 * std::numbers::pi * viscosities_.contrast() * (evaluation(0) * velocity) +
                            viscosities_.sum() * (axisymmetric.doubled * velocity);
    if (walls_) {
        Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(from_walls.cols());
        for (std::size_t i = 0; i < walls_->nodes().size(); ++i) {
            const Index node = static_cast<Index>(i);
            const double side = walls_->nodes()[i].segment < 3 ? 1.0 : -1.0;
            unknowns[3 * node] = side * base.walls[2 * node];
            unknowns[3 * node + 2] = side * base.walls[2 * node + 1];
        }
        right += from_walls * unknowns;
    }
    Eigen::MatrixXd matrix = axisymmetric.single * mode_space.forces();
    const Index count = matrix.rows();
    if (!mode_space.clamped()) {
        // Bordered by the normal: no mean normal traction.
        const MembraneSamples samples = sample(membrane_, base.membrane);
        Eigen::VectorXd normal = volume_gradient(membrane_, samples).transpose();
        matrix.conservativeResize(count + 1, count + 1);
        matrix.row(count).setZero();
        matrix.col(count).setZero();
        matrix.row(count).head(count) = normal.transpose();
        matrix.col(count).head(count) = normal;
        right.conservativeResize(count + 1);
        right[count] = 0.0;
    }
    const Eigen::VectorXd free = LuFactors(std::move(matrix), "one-sided traction").solve(right).topRows(count);
    const Eigen::VectorXd physical = mode_space.forces() * free;
    Eigen::VectorXd result(radial + force);
    result << physical.head(radial), physical.tail(force);
    return result;
}

}  // namespace endoflow::boundary_integral
