#include "boundary_integral/flow/flow_model.h"

#include <numbers>

#include "boundary_integral/flow/dense_solver.h"

namespace endoflow::boundary_integral {

VelocityFreedoms VelocityFreedoms::of_the_curve(const MembraneSpace& space) {
    return {space.radial_count(), space.axial_count(), space.fixed_radial(), space.fixed_axial()};
}

VelocityFreedoms VelocityFreedoms::with_inflow(const MembraneSpace& space, const MembraneState& state) {
    VelocityFreedoms freedoms = of_the_curve(space);
    freedoms.fixed_radial = 0;
    freedoms.inflow = true;
    const BasisRow axial = space.axial().basis(1.0);
    const CurvePoint rim = curve_point(space.radial().basis(1.0), axial, state);
    double slope_of_function = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
        if (axial.index[j] == freedoms.axial_count - 2) slope_of_function += axial.value[1][j];
    }
    freedoms.slope_factor = rim.z2 / rim.g / slope_of_function;
    return freedoms;
}

Eigen::MatrixXd VelocityFreedoms::expand(const Eigen::MatrixXd& values) const {
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(radial_count + axial_count, values.cols());
    full.topRows(radial()) = values.topRows(radial());
    full.middleRows(radial_count, axial()) = values.bottomRows(axial());
    if (inflow) full.row(radial_count + axial_count - 2) = slope_factor * values.row(radial_count - 1);
    return full;
}

Eigen::MatrixXd VelocityFreedoms::restrict_columns(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd result(matrix.rows(), count());
    result << matrix.leftCols(radial()), matrix.middleCols(radial_count, axial());
    if (inflow) result.col(radial_count - 1) += slope_factor * matrix.col(radial_count + axial_count - 2);
    return result;
}

Eigen::MatrixXd VelocityFreedoms::restrict_rows(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd result(count(), matrix.cols());
    result << matrix.topRows(radial()), matrix.middleRows(radial_count, axial());
    if (inflow) result.row(radial_count - 1) += slope_factor * matrix.row(radial_count + axial_count - 2);
    return result;
}

Eigen::MatrixXd FlowModel::constraint_matrix(const MembraneSamples& samples, const VelocityFreedoms& freedoms) const {
    const Index tensions = constraints_.local_area ? space_.tension().dimension() : 0;
    Eigen::MatrixXd matrix(tensions + (constraints_.volume ? 1 : 0), space_.curve_count());
    if (constraints_.local_area) matrix.topRows(tensions) = divergence_matrix(space_, samples);
    if (constraints_.volume) matrix.bottomRows(1) = volume_gradient(space_, samples);
    return freedoms.restrict_columns(matrix);
}

Eigen::MatrixXd FlowModel::constraint_variation(const MembraneSamples& samples, const Eigen::VectorXd& velocity) const {
    const Index tensions = constraints_.local_area ? space_.tension().dimension() : 0;
    Eigen::MatrixXd matrix(tensions + (constraints_.volume ? 1 : 0), space_.curve_count());
    if (constraints_.local_area) matrix.topRows(tensions) = divergence_variation(space_, samples, velocity);
    if (constraints_.volume) matrix.bottomRows(1) = volume_variation(space_, samples, velocity);
    return matrix;
}

FlowSolution FlowModel::solve(const MobilityOperators& operators, const MembraneSamples& samples,
                              const EnergyDerivatives& energy, double rim_energy_density,
                              const Eigen::VectorXd& external) const {
    const VelocityFreedoms& freedoms = operators.freedoms;
    FlowSolution flow;
    // <f, w> = -dE(w) - ∫ λ ∇_Γ·w for all w. Membrane that flows in through the rim is no change of
    // energy: its tangential motion carries the rim's energy density along, which dE counts as growth.
    Eigen::VectorXd gradient = freedoms.restrict_rows(energy.gradient);
    if (freedoms.inflow) gradient[space_.radial_count() - 1] -= samples.rim_radius * rim_energy_density;
    flow.load = -gradient;
    if (external.size() > 0) flow.load += freedoms.restrict_rows(external);
    flow.multipliers.tension = Eigen::VectorXd::Zero(space_.tension().dimension());
    if (constrained()) {
        const Eigen::MatrixXd constraint = constraint_matrix(samples, freedoms);
        const LuFactors schur(constraint * operators.mobility * constraint.transpose(), "tension");
        const Eigen::VectorXd values = schur.solve(constraint * (operators.mobility * flow.load));
        flow.load -= constraint.transpose() * values;
        if (constraints_.local_area) flow.multipliers.tension = values.head(space_.tension().dimension());
        if (constraints_.volume) flow.multipliers.pressure = values[values.size() - 1];
    }
    if (operators.force_from_load.size() > 0) flow.force = operators.force_from_load * flow.load;
    const Eigen::VectorXd velocity = operators.mobility * flow.load;
    flow.velocity = freedoms.expand(velocity);
    flow.inflow = freedoms.through_rim(velocity);
    flow.power = 2.0 * std::numbers::pi * flow.load.dot(velocity);
    if (external.size() > 0) flow.external_power = 2.0 * std::numbers::pi * external.dot(flow.velocity);
    return flow;
}

}  // namespace endoflow::boundary_integral
