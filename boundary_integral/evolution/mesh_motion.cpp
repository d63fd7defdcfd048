#include "boundary_integral/evolution/mesh_motion.h"

#include <cmath>
#include <utility>

#include "boundary_integral/membrane/energy.h"

namespace endoflow::boundary_integral {

namespace {

// ∫ a B_i' B_j' + b B_i B_j over ξ.
Eigen::MatrixXd one_dimensional_matrix(const MembraneSpace& space, const std::vector<BasisRow>& rows, Index dimension,
                                       double stiffness, double mass) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(dimension, dimension);
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const BasisRow& b = rows[i];
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = 0; k < 6; ++k) {
                matrix(b.index[j], b.index[k]) += space.weight[i] * (stiffness * b.value[1][j] * b.value[1][k] +
                                                                     mass * b.value[0][j] * b.value[0][k]);
            }
        }
    }
    return matrix;
}

double inflow_profile(double xi) {
    return xi * xi * xi * xi * xi;
}

}  // namespace

MeshMotion::MeshMotion(const MembraneSpace& space, const MeshDensity& density, MeshCarrier carrier)
    : space_(space),
      density_(density),
      carrier_(carrier),
      radial_points_(space.radial().greville_points()),
      axial_points_(space.axial().greville_points()),
      radial_interpolation_(inverse(collocation_matrix(space.radial(), radial_points_), "interpolation")),
      axial_interpolation_(inverse(collocation_matrix(space.axial(), axial_points_), "interpolation")),
      filter_(inverse(one_dimensional_matrix(space, space.axial_rows, space.axial_count(),
                                             density.smoothing * density.smoothing, 1.0),
                      "mesh filter")),
      antiderivative_(
          inverse(one_dimensional_matrix(space, space.radial_rows, space.radial_count(), 1.0, 0.0), "antiderivative")),
      identity_(Eigen::VectorXd::Zero(space.radial_count())) {
    if (space.end() == CurveEnd::clamped) {
        identity_ = Eigen::Map<const Eigen::VectorXd>(radial_points_.data(), space.radial_count());
    }
}

double MeshMotion::wanted_density(const CurvePoint& p, double c1) const {
    const double length = density_.curvature_length;
    const double bend =
        length * length *
        (p.meridional_curvature * p.meridional_curvature + p.azimuthal_curvature * p.azimuthal_curvature);
    const double edge = density_.edge_length * c1 / p.g;
    return std::sqrt(1.0 + bend + edge * edge);
}

// ρ - l² ρ'' = wanted: neighbouring elements differ by a factor of at most exp(h/l).
std::vector<double> MeshMotion::filtered_density(const MembraneSamples& samples) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(space_.axial_count());
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const double wanted = wanted_density(samples.curve[i], samples.c1[i]);
        const BasisRow& b = space_.axial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) right[b.index[j]] += space_.weight[i] * wanted * b.value[0][j];
    }
    return values_at_points(space_.axial_rows, filter_ * right);
}

// ∫ B' (N - ξ)' dξ = ∫ B' (ρ g/total - 1) dξ; mirrored at both ends, the 1 has no part in the space.
Eigen::VectorXd MeshMotion::numbers_ahead(const MembraneSamples& samples) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(space_.radial_count());
    const std::vector<double> density = filtered_density(samples);
    double total = 0.0;
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const double value = space_.weight[i] * density[i] * samples.curve[i].g;
        total += value;
        const BasisRow& b = space_.radial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) right[b.index[j]] += value * b.value[1][j];
    }
    return antiderivative_ * right / total - identity_;
}

template <class Speed>
Eigen::VectorXd MeshMotion::interpolate_tangential(const MembraneState& state, Speed speed) const {
    Eigen::MatrixXd r(space_.radial_count(), 1), z(space_.axial_count(), 1);
    const auto point = [&](double xi) {
        return curve_point(space_.radial().basis(xi), space_.axial().basis(xi), state);
    };
    for (std::size_t i = 0; i < radial_points_.size(); ++i) {
        const CurvePoint p = point(radial_points_[i]);
        r(static_cast<Index>(i), 0) = speed(radial_points_[i], p) * p.r1 / p.g;
    }
    for (std::size_t i = 0; i < axial_points_.size(); ++i) {
        const CurvePoint p = point(axial_points_[i]);
        z(static_cast<Index>(i), 0) = speed(axial_points_[i], p) * p.z1 / p.g;
    }
    Eigen::VectorXd field(space_.curve_count());
    field << radial_interpolation_ * r, axial_interpolation_ * z;
    return field;
}

// u.t = u.x'/g, and δt = n (n.δx')/g.
MeshMotion::Slip MeshMotion::slip(double xi, const CurvePoint& p, double u_r, double u_z, double inflow) const {
    if (carrier_ == MeshCarrier::material) {
        return {-inflow * inflow_profile(xi), 0.0, 0.0, 0.0, 0.0, -inflow_profile(xi)};
    }
    const double turning = -(u_r * p.normal_r + u_z * p.normal_z) / p.g;
    return {
        -(u_r * p.r1 + u_z * p.z1) / p.g, turning * p.normal_r, turning * p.normal_z, -p.r1 / p.g, -p.z1 / p.g, 0.0};
}

Eigen::VectorXd MeshMotion::tangential_velocity(const MembraneState& state, const MembraneSamples& samples,
                                                const Eigen::VectorXd& velocity, double inflow) const {
    const Eigen::VectorXd ahead = numbers_ahead(samples);
    const Eigen::VectorXd u_r = velocity.head(space_.radial_count()), u_z = velocity.tail(space_.axial_count());
    return interpolate_tangential(state, [&](double xi, const CurvePoint& p) {
        const BasisRow b = space_.radial().basis(xi);
        return slip(xi, p, b.evaluate(u_r), space_.axial().basis(xi).evaluate(u_z), inflow).speed -
               b.evaluate(ahead, 0) * p.g / (density_.relaxation_time * (1.0 + b.evaluate(ahead, 1)));
    });
}

MeshMotion::Derivatives MeshMotion::derivatives(const MembraneState& state, const MembraneSamples& samples,
                                                const Eigen::VectorXd& velocity, double inflow) const {
    const Index offset = space_.radial_count(), curve = space_.curve_count(), axial_count = space_.axial_count();
    const Index variables = curve + axial_count;  // (r, z, c) coefficients
    const double length = density_.curvature_length;
    const std::vector<double> density = filtered_density(samples);

    // Variations of the unfiltered density against the axial functions, of ∫ ρ g B' and of its total; the last two
    // first at fixed ρ, with what a variation of ρ adds to them.
    Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(axial_count, variables);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(offset, variables);
    Eigen::MatrixXd right_by_density = Eigen::MatrixXd::Zero(offset, axial_count);
    Eigen::RowVectorXd total_variation = Eigen::RowVectorXd::Zero(variables);
    Eigen::RowVectorXd total_by_density = Eigen::RowVectorXd::Zero(axial_count);
    double total = 0.0;
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow& b = space_.radial_rows[i];
        const BasisRow& a = space_.axial_rows[i];
        const double weight = space_.weight[i], c1 = samples.c1[i];
        const double per_wanted = weight / wanted_density(p, c1);
        const double m = length * length * p.meridional_curvature, q = length * length * p.azimuthal_curvature;
        const double square = p.g * p.g, cube = square * p.g;
        const double by_c1 = density_.edge_length * density_.edge_length * c1 / square;
        const double stretch = -(3.0 * m * p.meridional_curvature + q * p.azimuthal_curvature + by_c1 * c1) / square;
        const double by_r = -q * p.azimuthal_curvature / p.r;
        const double by_r1 = -m * p.z2 / cube + stretch * p.r1, by_r2 = m * p.z1 / cube;
        const double by_z1 = m * p.r2 / cube + stretch * p.z1 - q / (p.r * p.g), by_z2 = -m * p.r1 / cube;
        const double rho = weight * density[i];
        total += rho * p.g;
        for (std::size_t k = 0; k < 6; ++k) {
            const double from_r = rho * p.r1 / p.g * b.value[1][k], from_z = rho * p.z1 / p.g * a.value[1][k];
            const double wanted_r = per_wanted * (by_r * b.value[0][k] + by_r1 * b.value[1][k] + by_r2 * b.value[2][k]);
            const double wanted_z = per_wanted * (by_z1 * a.value[1][k] + by_z2 * a.value[2][k]);
            const double wanted_c = per_wanted * by_c1 * a.value[1][k];
            total_variation[b.index[k]] += from_r;
            total_variation[offset + a.index[k]] += from_z;
            total_by_density[a.index[k]] += weight * p.g * a.value[0][k];
            for (std::size_t j = 0; j < 6; ++j) {
                right(b.index[j], b.index[k]) += b.value[1][j] * from_r;
                right(b.index[j], offset + a.index[k]) += b.value[1][j] * from_z;
                right_by_density(b.index[j], a.index[k]) += weight * p.g * b.value[1][j] * a.value[0][k];
                wanted(a.index[j], b.index[k]) += a.value[0][j] * wanted_r;
                wanted(a.index[j], offset + a.index[k]) += a.value[0][j] * wanted_z;
                wanted(a.index[j], curve + a.index[k]) += a.value[0][j] * wanted_c;
            }
        }
    }
    const Eigen::MatrixXd density_variation = filter_ * wanted;
    right += right_by_density * density_variation;
    total_variation += total_by_density * density_variation;
    const Eigen::VectorXd ahead_of_xi = numbers_ahead(samples);
    const Eigen::MatrixXd variation = (antiderivative_ * right - (ahead_of_xi + identity_) * total_variation) / total;

    // α t = α_0 x'/g - (N - ξ) x'/(τ N') at the interpolation points, by (r, z, c), by the inflow and, where it counts,
    // by the velocity (both components).
    const bool carried = carrier_ == MeshCarrier::normal_motion;
    const Index by_inflow = variables, by_velocity = variables + 1, columns = by_velocity + (carried ? curve : 0);
    const double rate = 1.0 / density_.relaxation_time;
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(offset, columns), z = Eigen::MatrixXd::Zero(axial_count, columns);
    const Eigen::VectorXd u_r = velocity.head(offset), u_z = velocity.tail(axial_count);
    const auto fill = [&](double xi, bool radial, auto row) {
        const BasisRow b = space_.radial().basis(xi);
        const BasisRow a = space_.axial().basis(xi);
        const CurvePoint p = curve_point(b, a, state);
        const double slope = 1.0 + b.evaluate(ahead_of_xi, 1), ahead = b.evaluate(ahead_of_xi, 0);
        const double component = radial ? p.r1 : p.z1;
        const double tangent = component / p.g;
        const double normal = radial ? p.normal_r : p.normal_z;
        const Slip s = slip(xi, p, b.evaluate(u_r), a.evaluate(u_z), inflow);
        const double turning = s.speed * normal / p.g;
        for (std::size_t j = 0; j < 6; ++j) {
            const double by_numbers = -rate * component / slope * (b.value[0][j] - ahead / slope * b.value[1][j]);
            row.head(variables) += by_numbers * variation.row(b.index[j]);
            row(b.index[j]) += (turning * p.normal_r + tangent * s.by_r1) * b.value[1][j];
            row(offset + a.index[j]) += (turning * p.normal_z + tangent * s.by_z1) * a.value[1][j];
            row(radial ? b.index[j] : offset + a.index[j]) -=
                rate * ahead / slope * (radial ? b.value[1][j] : a.value[1][j]);
            if (!carried) continue;
            row(by_velocity + b.index[j]) += tangent * s.by_u_r * b.value[0][j];
            row(by_velocity + offset + a.index[j]) += tangent * s.by_u_z * a.value[0][j];
        }
        row(by_inflow) = tangent * s.by_inflow;
    };
    for (std::size_t i = 0; i < radial_points_.size(); ++i) fill(radial_points_[i], true, r.row(static_cast<Index>(i)));
    for (std::size_t i = 0; i < axial_points_.size(); ++i) fill(axial_points_[i], false, z.row(static_cast<Index>(i)));
    Eigen::MatrixXd all(curve, columns);
    all << radial_interpolation_ * r, axial_interpolation_ * z;
    Derivatives result;
    result.by_curve = all.leftCols(curve);
    result.by_concentration = all.middleCols(curve, axial_count);
    if (carried) result.by_velocity = all.middleCols(by_velocity, curve);
    result.by_inflow = all.col(by_inflow);
    return result;
}

Interpolation::Interpolation(const SplineSpace& space)
    : factors_(collocation_matrix(space, space.greville_points()), "interpolation") {}

Eigen::VectorXd Interpolation::operator()(const std::vector<double>& values) const {
    return factors_.solve(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size())));
}

Eigen::VectorXd interpolate(const SplineSpace& space, const std::vector<double>& values) {
    return Interpolation(space)(values);
}

}  // namespace endoflow::boundary_integral
