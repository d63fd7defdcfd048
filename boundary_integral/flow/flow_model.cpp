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

FlowSolution FlowModel::solve(const MobilityOperators& operators, const MembraneSamples& samples,
                              const EnergyDerivatives& energy, double rim_energy_density) const {
    const VelocityFreedoms& freedoms = operators.freedoms;
    FlowSolution flow;
    // <f, w> = -dE(w) - int lambda div_Gamma w for all w. Membrane that flows in through the rim is no change of
    // energy: its tangential motion carries the rim's energy density along, which dE counts as growth.
    Eigen::VectorXd gradient = freedoms.restrict_rows(energy.gradient);
    if (freedoms.inflow) gradient[space_.radial_count() - 1] -= samples.rim_radius * rim_energy_density;
    flow.load = -gradient;
    if (inextensible_) {
        const Eigen::MatrixXd divergence = freedoms.restrict_columns(divergence_matrix(space_, samples));
        const Eigen::MatrixXd response = operators.mobility * divergence.transpose();
        const LuFactors schur(divergence * response, "tension");
        flow.tension = schur.solve(divergence * (operators.mobility * flow.load));
        flow.load -= divergence.transpose() * flow.tension;
    } else {
        flow.tension = Eigen::VectorXd::Zero(space_.tension().dimension());
    }
    if (operators.force_from_load.size() > 0) flow.force = operators.force_from_load * flow.load;
    const Eigen::VectorXd velocity = operators.mobility * flow.load;
    flow.velocity = freedoms.expand(velocity);
    flow.inflow = freedoms.through_rim(velocity);
    flow.power = 2.0 * std::numbers::pi * flow.load.dot(velocity);
    return flow;
}

}  // namespace endoflow::boundary_integral
