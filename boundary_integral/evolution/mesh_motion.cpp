#include "boundary_integral/evolution/mesh_motion.h"

#include <cmath>

#include "boundary_integral/membrane/energy.h"

namespace endoflow::boundary_integral {

namespace {

// int a B_i' B_j' + b B_i B_j over xi.
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

MeshMotion::MeshMotion(const MembraneSpace& space, const MeshDensity& density)
    : space_(space),
      density_(density),
      radial_points_(space.radial().greville_points()),
      axial_points_(space.axial().greville_points()),
      radial_interpolation_(collocation_matrix(space.radial(), radial_points_), "interpolation"),
      axial_interpolation_(collocation_matrix(space.axial(), axial_points_), "interpolation"),
      filter_(one_dimensional_matrix(space, space.axial_rows, space.axial_count(),
                                     density.smoothing * density.smoothing, 1.0),
              "mesh filter"),
      antiderivative_(one_dimensional_matrix(space, space.radial_rows, space.radial_count(), 1.0, 0.0),
                      "antiderivative") {}

double MeshMotion::relaxation_rate(const Eigen::VectorXd& velocity) const {
    constexpr double slow_speed = 1.0;  // nm/us
    constexpr double at_rest = 0.1;
    const Eigen::VectorXd u_r = velocity.head(space_.radial_count()), u_z = velocity.tail(space_.axial_count());
    double squared = 0.0;
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const double r = space_.radial_rows[i].evaluate(u_r), z = space_.axial_rows[i].evaluate(u_z);
        squared += space_.weight[i] * (r * r + z * z);
    }
    const double speed = std::sqrt(squared);
    return (at_rest + (1.0 - at_rest) * speed / (speed + slow_speed)) / density_.relaxation_time;
}

// rho - l^2 rho'' = wanted: neighbouring elements differ by a factor of at most exp(h/l).
std::vector<double> MeshMotion::filtered_density(const MembraneSamples& samples) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(space_.axial_count());
    const double length = density_.curvature_length;
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double bend =
            length * length *
            (p.meridional_curvature * p.meridional_curvature + p.azimuthal_curvature * p.azimuthal_curvature);
        const double edge = density_.edge_weight * 4.0 * samples.c[i] * (1.0 - samples.c[i]);
        const double wanted = std::sqrt(1.0 + bend + edge * edge);
        const BasisRow& b = space_.axial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) right[b.index[j]] += space_.weight[i] * wanted * b.value[0][j];
    }
    return values_at_points(space_.axial_rows, filter_.solve(right));
}

Eigen::VectorXd MeshMotion::wanted_numbers(const MembraneSamples& samples) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(space_.radial_count());
    const std::vector<double> density = filtered_density(samples);
    double total = 0.0;
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const double value = space_.weight[i] * density[i] * samples.curve[i].g;
        total += value;
        const BasisRow& b = space_.radial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) right[b.index[j]] += value * b.value[1][j];
    }
    return antiderivative_.solve(right / total);
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
    field << radial_interpolation_.solve(r), axial_interpolation_.solve(z);
    return field;
}

Eigen::VectorXd MeshMotion::tangential_velocity(const MembraneState& state, const MembraneSamples& samples,
                                                double inflow, double rate) const {
    const Eigen::VectorXd numbers = wanted_numbers(samples);
    return interpolate_tangential(state, [&](double xi, const CurvePoint& p) {
        const BasisRow b = space_.radial().basis(xi);
        return -inflow * inflow_profile(xi) - (b.evaluate(numbers, 0) - xi) * p.g * rate / b.evaluate(numbers, 1);
    });
}

Eigen::VectorXd MeshMotion::derivative_by_inflow(const MembraneState& state) const {
    return interpolate_tangential(state, [](double xi, const CurvePoint&) { return -inflow_profile(xi); });
}

Eigen::MatrixXd MeshMotion::derivative_by_curve(const MembraneState& state, const MembraneSamples& samples,
                                                double rate) const {
    // delta N = S^-1 int B' rho delta g / total - N delta total/total, delta g = (r' delta r' + z' delta z')/g
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(space_.radial_count(), space_.curve_count());
    Eigen::RowVectorXd total_variation = Eigen::RowVectorXd::Zero(space_.curve_count());
    double total = 0.0;
    const Index offset = space_.radial_count();
    const std::vector<double> density = filtered_density(samples);
    for (std::size_t i = 0; i < space_.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double rho = space_.weight[i] * density[i];
        total += rho * p.g;
        const BasisRow& b = space_.radial_rows[i];
        const BasisRow& a = space_.axial_rows[i];
        for (std::size_t k = 0; k < 6; ++k) {
            const double from_r = rho * p.r1 / p.g * b.value[1][k];
            const double from_z = rho * p.z1 / p.g * a.value[1][k];
            total_variation[b.index[k]] += from_r;
            total_variation[offset + a.index[k]] += from_z;
            for (std::size_t j = 0; j < 6; ++j) {
                right(b.index[j], b.index[k]) += b.value[1][j] * from_r;
                right(b.index[j], offset + a.index[k]) += b.value[1][j] * from_z;
            }
        }
    }
    const Eigen::VectorXd numbers = wanted_numbers(samples);
    const Eigen::MatrixXd variation = (antiderivative_.solve(right) - numbers * total_variation) / total;
    Eigen::MatrixXd r(space_.radial_count(), space_.curve_count()), z(space_.axial_count(), space_.curve_count());
    const auto row = [&](double xi, bool radial) -> Eigen::RowVectorXd {
        const BasisRow b = space_.radial().basis(xi);
        const CurvePoint p = curve_point(b, space_.axial().basis(xi), state);
        Eigen::RowVectorXd change = Eigen::RowVectorXd::Zero(space_.curve_count());
        for (std::size_t j = 0; j < 6; ++j) change += b.value[0][j] * variation.row(b.index[j]);
        const double tangent = radial ? p.r1 : p.z1;  // t g
        return -change * tangent * rate / b.evaluate(numbers, 1);
    };
    for (std::size_t i = 0; i < radial_points_.size(); ++i) r.row(static_cast<Index>(i)) = row(radial_points_[i], true);
    for (std::size_t i = 0; i < axial_points_.size(); ++i) z.row(static_cast<Index>(i)) = row(axial_points_[i], false);
    Eigen::MatrixXd result(space_.curve_count(), space_.curve_count());
    result << radial_interpolation_.solve(r), axial_interpolation_.solve(z);
    return result;
}

Eigen::VectorXd interpolate(const SplineSpace& space, const std::vector<double>& values) {
    const LuFactors factors(collocation_matrix(space, space.greville_points()), "interpolation");
    return factors.solve(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size())));
}

}  // namespace endoflow::boundary_integral
