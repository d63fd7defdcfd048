#include "boundary_integral/evolution/membrane_dynamics.h"

#include "shared/model/initial_condition.h"

namespace endoflow::boundary_integral {

MembraneDynamics::MembraneDynamics(const Parameters& parameters)
    : parameters_(parameters),
      space_(parameters.boundary_integral.elements, parameters.boundary_integral.quadrature_order),
      model_(parameters.membrane),
      box_(parameters, space_),
      mesh_(space_, {parameters.boundary_integral.mesh_curvature_length, parameters.boundary_integral.mesh_edge_weight,
                     parameters.boundary_integral.mesh_relaxation_time, parameters.boundary_integral.mesh_smoothing}) {}

Eigen::VectorXd MembraneDynamics::pack(const Eigen::VectorXd& curve, const Eigen::VectorXd& moments) const {
    Eigen::VectorXd y(size());
    y << curve.head(free_radial()), curve.segment(space_.radial_count(), free_axial()), moments;
    return y;
}

Eigen::MatrixXd MembraneDynamics::pack_rows(const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd packed(free_radial() + free_axial(), rows.cols());
    packed << rows.topRows(free_radial()), rows.middleRows(space_.radial_count(), free_axial());
    return packed;
}

Eigen::MatrixXd MembraneDynamics::pack_columns(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd packed(columns.rows(), free_radial() + free_axial());
    packed << columns.leftCols(free_radial()), columns.middleCols(space_.radial_count(), free_axial());
    return packed;
}

Eigen::VectorXd MembraneDynamics::initial_vector() const {
    MembraneState state;
    const std::vector<double> radial_points = space_.radial().greville_points();
    const std::vector<double> axial_points = space_.axial().greville_points();
    std::vector<double> r = radial_points;
    for (double& value : r) value *= parameters_.domain.radius;
    state.r = interpolate(space_.radial(), r);
    state.z = Eigen::VectorXd::Constant(space_.axial_count(), parameters_.domain.membrane_height);
    constexpr int sweeps = 200;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        std::vector<double> c;
        for (double xi : axial_points) {
            c.push_back(initial_concentration(parameters_.molecules, space_.radial().basis(xi).evaluate(state.r)));
        }
        state.c = interpolate(space_.axial(), c);
        if (sweep + 1 == sweeps) break;
        const Eigen::VectorXd numbers = mesh_.wanted_numbers(sample(space_, state));
        for (std::size_t i = 0; i < r.size(); ++i) {
            const BasisRow b = space_.radial().basis(radial_points[i]);
            r[i] -= 0.3 * (b.evaluate(numbers, 0) - radial_points[i]) * b.evaluate(state.r, 1) / b.evaluate(numbers, 1);
        }
        r.back() = parameters_.domain.radius;
        state.r = interpolate(space_.radial(), r);
    }
    const MembraneSamples samples = sample(space_, state);
    Eigen::VectorXd curve(space_.curve_count());
    curve << state.r, state.z;
    return pack(curve, surface_mass_matrix(space_, samples.curve) * state.c);
}

MembraneState MembraneDynamics::unpack(const Eigen::VectorXd& y) const {
    MembraneState state;
    state.r.resize(space_.radial_count());
    state.r << y.head(free_radial()), parameters_.domain.radius;
    state.z.resize(space_.axial_count());
    const double rim = parameters_.domain.membrane_height;
    state.z << y.segment(free_radial(), free_axial()), rim, rim;
    state.c = Eigen::VectorXd::Zero(space_.axial_count());
    state.c = concentration_from_moments(space_, sample(space_, state).curve, y.tail(space_.axial_count()));
    return state;
}

Evaluation MembraneDynamics::evaluate(const Eigen::VectorXd& y) const {
    const MembraneState state = unpack(y);
    const MembraneSamples samples = sample(space_, state);
    Evaluation e{state,
                 samples,
                 bending_energy(space_, state, model_, Derivatives::first),
                 box_.operators(state, samples),
                 {},
                 {},
                 {},
                 {}};
    e.flow = box_.solve(e.operators, e.samples, e.energy, energy_density_at_rim(space_, state, model_));
    const Eigen::VectorXd tangential =
        mesh_.tangential_velocity(state, samples, e.flow.inflow, mesh_.relaxation_rate(e.flow.velocity));
    e.mesh_velocity = e.flow.velocity + tangential;
    const Eigen::VectorXd t_r = tangential.head(space_.radial_count());
    const Eigen::VectorXd t_z = tangential.tail(space_.axial_count());
    e.relative_velocity.resize(samples.curve.size());
    for (std::size_t i = 0; i < samples.curve.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        e.relative_velocity[i] =
            -(space_.radial_rows[i].evaluate(t_r) * p.r1 + space_.axial_rows[i].evaluate(t_z) * p.z1) / p.g;
    }
    e.rate = pack(e.mesh_velocity, diffusion_rate(space_, samples, state.c, parameters_.molecules) +
                                       advection_rate(space_, samples, e.relative_velocity));
    return e;
}

Eigen::MatrixXd MembraneDynamics::jacobian(const Evaluation& e) const {
    const Index curve = free_radial() + free_axial();
    const Index moments = space_.axial_count();
    const ClampedVelocities& clamped = e.operators.clamped;
    const std::vector<double> tension = values_at_points(space_.tension_rows, e.flow.tension);
    const EnergyDerivatives second = bending_energy(space_, e.state, model_, Derivatives::second, tension);

    // Velocity freedoms: delta u = Y delta load with C delta u = - delta C u.
    Eigen::MatrixXd load_curve = -clamped.restrict_rows(pack_columns(second.hessian));
    Eigen::MatrixXd load_c = -clamped.restrict_rows(second.mixed);
    Eigen::MatrixXd velocity_curve = e.operators.mobility * load_curve;
    Eigen::MatrixXd velocity_c = e.operators.mobility * load_c;
    if (box_.inextensible()) {
        const Eigen::MatrixXd divergence = clamped.restrict_columns(divergence_matrix(space_, e.samples));
        const Eigen::MatrixXd response = e.operators.mobility * divergence.transpose();
        const LuFactors schur(divergence * response, "tension");
        const Eigen::MatrixXd stretching = pack_columns(divergence_variation(space_, e.samples, e.flow.velocity));
        velocity_curve -= response * schur.solve(divergence * velocity_curve + stretching);
        velocity_c -= response * schur.solve(divergence * velocity_c);
    }
    const Eigen::VectorXd by_inflow = mesh_.derivative_by_inflow(e.state);
    const auto mesh_rate = [&](const Eigen::MatrixXd& freedoms) {
        Eigen::MatrixXd full = Eigen::MatrixXd::Zero(space_.curve_count(), freedoms.cols());
        full.topRows(clamped.freedoms()) = freedoms;
        full += by_inflow * freedoms.row(space_.radial_count() - 1);
        return pack_rows(full);
    };
    const Eigen::MatrixXd rate_curve =
        mesh_rate(velocity_curve) +
        pack_rows(pack_columns(mesh_.derivative_by_curve(e.state, e.samples, mesh_.relaxation_rate(e.flow.velocity))));
    const Eigen::MatrixXd rate_c = mesh_rate(velocity_c);

    const TransportDerivatives transport =
        transport_derivatives(space_, e.samples, e.state.c, parameters_.molecules, e.relative_velocity);
    const Eigen::MatrixXd c_from_curve = pack_columns(transport.c_from_curve);
    Eigen::MatrixXd jacobian(size(), size());
    jacobian.topLeftCorner(curve, curve) = rate_curve + rate_c * c_from_curve;
    jacobian.topRightCorner(curve, moments) = rate_c * transport.c_from_moments;
    jacobian.bottomLeftCorner(moments, curve) =
        pack_columns(transport.rate_from_curve) + transport.rate_from_c * c_from_curve;
    jacobian.bottomRightCorner(moments, moments) = transport.rate_from_c * transport.c_from_moments;
    return jacobian;
}

Eigen::VectorXd MembraneDynamics::error_scales(const Eigen::VectorXd& y, double length, double concentration) const {
    const MembraneSamples samples = sample(space_, unpack(y));
    Eigen::VectorXd areas = surface_mass_matrix(space_, samples.curve) * Eigen::VectorXd::Ones(space_.axial_count());
    return pack(Eigen::VectorXd::Constant(space_.curve_count(), length), concentration * areas);
}

}  // namespace endoflow::boundary_integral
