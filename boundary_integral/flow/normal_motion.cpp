#include "boundary_integral/flow/normal_motion.h"

#include "boundary_integral/flow/dense_solver.h"

namespace endoflow::boundary_integral {

namespace {

/// ∫ (w A w') dA between velocities (curve_count), A the projection on the normal or the unit matrix.
enum class Metric { all, normal };

Eigen::MatrixXd metric_matrix(const MembraneSpace& space, const MembraneSamples& samples, Metric metric) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.curve_count(), space.curve_count());
    const Index offset = space.radial_count();
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double measure = space.weight[i] * p.r * p.g;
        const bool normal = metric == Metric::normal;
        const double rr = measure * (normal ? p.normal_r * p.normal_r : 1.0);
        const double rz = measure * (normal ? p.normal_r * p.normal_z : 0.0);
        const double zz = measure * (normal ? p.normal_z * p.normal_z : 1.0);
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& axial = space.axial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = 0; k < 6; ++k) {
                const double mixed = rz * radial.value[0][j] * axial.value[0][k];
                matrix(radial.index[j], radial.index[k]) += rr * radial.value[0][j] * radial.value[0][k];
                matrix(radial.index[j], offset + axial.index[k]) += mixed;
                matrix(offset + axial.index[k], radial.index[j]) += mixed;
                matrix(offset + axial.index[j], offset + axial.index[k]) += zz * axial.value[0][j] * axial.value[0][k];
            }
        }
    }
    return matrix;
}

}  // namespace

MobilityOperators NormalMotion::operators(const MembraneState&, const MembraneSamples& samples) const {
    MobilityOperators result;
    result.samples = samples;
    result.freedoms = VelocityFreedoms::of_the_curve(space());
    const auto restricted = [&](Metric metric) {
        return result.freedoms.restrict_columns(result.freedoms.restrict_rows(metric_matrix(space(), samples, metric)));
    };
    const LuFactors mass(restricted(Metric::all), "velocity mass");
    const Eigen::MatrixXd half = mass.solve(restricted(Metric::normal));
    result.mobility = mobility_ * mass.solve(half.transpose());
    return result;
}

}  // namespace endoflow::boundary_integral
