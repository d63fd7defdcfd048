#include "boundary_integral/evolution/membrane_dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "boundary_integral/flow/free_space_flow.h"
#include "boundary_integral/flow/normal_motion.h"
#include "shared/geometry/initial_curve.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

std::unique_ptr<FlowModel> make_flow(const Parameters& parameters, const MembraneSpace& space) {
    if (parameters.fluid.dynamics == Dynamics::geometric) return std::make_unique<NormalMotion>(parameters, space);
    if (parameters.domain.kind == DomainKind::free_space) return std::make_unique<FreeSpaceFlow>(parameters, space);
    return std::make_unique<BoxFlow>(parameters, space);
}

// values + part * steps with the largest part, halved from `part` on, that leaves points + values in their order, each
// interval at least a fifth of what it was.
std::vector<double> without_crossing(const std::vector<double>& points, const std::vector<double>& values,
                                     const std::vector<double>& steps, double part) {
    constexpr double least_interval = 0.2, smallest_part = 1e-6;
    const auto crosses = [&] {
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double before = points[i] - points[i - 1] + values[i] - values[i - 1];
            if (before + part * (steps[i] - steps[i - 1]) < least_interval * before) return true;
        }
        return false;
    };
    while (crosses() && part > smallest_part) part *= 0.5;
    std::vector<double> moved = values;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += part * steps[i];
    return moved;
}

// Elements that fold over each other carry no membrane.
void require_order(const MembraneSpace& space, const Eigen::VectorXd& shift, const MoleculeParameters& molecules) {
    const bool ordered =
        std::ranges::all_of(space.radial_rows, [&](const BasisRow& row) { return 1.0 + row.evaluate(shift, 1) > 0.0; });
    if (!ordered)
        throw SolverError(
            "unresolved-coat-edge",
            fmt::format("{} elements find no places around an edge of molecules.interface_width = {:g} nm",
                        space.elements(), molecules.interface_width),
            "raise it, or lower boundary_integral.mesh_edge_length");
}

}  // namespace

MembraneDynamics::MembraneDynamics(const Parameters& parameters)
    : parameters_(parameters),
      space_(parameters.boundary_integral.elements, parameters.boundary_integral.quadrature_order,
             parameters.domain.kind == DomainKind::box ? CurveEnd::clamped : CurveEnd::closed),
      maturation_(parameters.molecules),
      loads_(loads_of(parameters)),
      transport_(transport_law(parameters.molecules)),
      exchange_(exchange_law(parameters.molecules)),
      flow_(make_flow(parameters, space_)),
      mesh_(space_,
            {parameters.boundary_integral.mesh_curvature_length, parameters.boundary_integral.mesh_edge_length,
             parameters.boundary_integral.mesh_relaxation_time, parameters.boundary_integral.mesh_smoothing},
            flow_->keeps_local_area() ? MeshCarrier::material : MeshCarrier::normal_motion) {}

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

// Moves the nodes along the initial curve until the mesh is the one that the density wants.
Eigen::VectorXd MembraneDynamics::initial_vector() const {
    const InitialCurve initial(parameters_);
    const std::vector<double> points = space_.radial().greville_points();
    const Interpolation radial(space_.radial()), axial(space_.axial());
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(space_.radial_count());  // s - ξ, s the initial curve's parameter
    const auto parameter = [&](double xi) { return xi + space_.radial().basis(xi).evaluate(shift); };
    MembraneState state;
    constexpr int sweeps = 200;
    constexpr double relaxation = 0.3, least_density = 0.1;
    for (int sweep = 0;; ++sweep) {
        std::vector<double> r, z, c;
        for (const double xi : points) r.push_back(initial.radius(parameter(xi)));
        for (const double xi : space_.axial().greville_points()) {
            z.push_back(initial.height(parameter(xi)));
            c.push_back(initial.concentration(parameter(xi)));
        }
        state = {radial(r), axial(z), axial(c)};
        if (sweep + 1 == sweeps) break;
        const Eigen::VectorXd ahead = mesh_.numbers_ahead(sample(space_, state));
        std::vector<double> now, step;
        for (const double xi : points) {
            const BasisRow b = space_.radial().basis(xi);
            now.push_back(b.evaluate(shift));
            step.push_back(-b.evaluate(ahead) * (1.0 + b.evaluate(shift, 1)) /
                           std::max(least_density, 1.0 + b.evaluate(ahead, 1)));
        }
        if (space_.end() == CurveEnd::clamped) now.back() = step.back() = 0.0;
        shift = radial(without_crossing(points, now, step, relaxation));
    }
    require_order(space_, shift, parameters_.molecules);
    return packed(state);
}

Eigen::VectorXd MembraneDynamics::packed(const MembraneState& state) const {
    Eigen::VectorXd curve(space_.curve_count());
    curve << state.r, state.z;
    return pack(curve, surface_mass_matrix(space_, sample(space_, state).curve) * state.c);
}

MembraneState MembraneDynamics::unpack(const Eigen::VectorXd& y) const {
    MembraneState state;
    state.r = Eigen::VectorXd::Constant(space_.radial_count(), parameters_.domain.radius);
    state.r.head(free_radial()) = y.head(free_radial());
    state.z = Eigen::VectorXd::Constant(space_.axial_count(), parameters_.domain.membrane_height);
    state.z.head(free_axial()) = y.segment(free_radial(), free_axial());
    state.c = Eigen::VectorXd::Zero(space_.axial_count());
    state.c = concentration_from_moments(space_, sample(space_, state).curve, y.tail(space_.axial_count()));
    return state;
}

std::shared_ptr<const MobilityOperators> MembraneDynamics::operators(const Eigen::VectorXd& y) const {
    const MembraneState state = unpack(y);
    return std::make_shared<const MobilityOperators>(flow_->operators(state, sample(space_, state)));
}

Evaluation MembraneDynamics::evaluate(double time, const Eigen::VectorXd& y,
                                      std::shared_ptr<const MobilityOperators> operators) const {
    const MembraneState state = unpack(y);
    const MembraneSamples samples = sample(space_, state);
    const MembraneEnergy energy = membrane_energy(parameters_, time);
    Evaluation e{time,
                 state,
                 samples,
                 energy_derivatives(space_, state, energy, Derivatives::first),
                 std::move(operators),
                 {},
                 {},
                 {},
                 {},
                 {},
                 {}};
    const double rim_energy_density =
        space_.end() == CurveEnd::clamped ? energy_density_at_rim(space_, state, energy) : 0.0;
    const Eigen::VectorXd external = loads_.none() ? Eigen::VectorXd() : external_load(space_, samples, loads_);
    e.flow = flow_->solve(*e.operators, e.samples, e.energy, rim_energy_density, external);
    const Eigen::VectorXd tangential = mesh_.tangential_velocity(state, samples, e.flow.velocity, e.flow.inflow);
    e.mesh_velocity = e.flow.velocity + tangential;
    const Eigen::VectorXd t_r = tangential.head(space_.radial_count());
    const Eigen::VectorXd t_z = tangential.tail(space_.axial_count());
    e.relative_velocity.resize(samples.curve.size());
    for (std::size_t i = 0; i < samples.curve.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        e.relative_velocity[i] =
            -(space_.radial_rows[i].evaluate(t_r) * p.r1 + space_.axial_rows[i].evaluate(t_z) * p.z1) / p.g;
    }
    e.diffusion = diffusion_rate(space_, samples, state.c, transport_, e.energy);
    e.exchange = exchange_rate(space_, samples, exchange_, bending_energy(parameters_, time));
    Eigen::VectorXd moments = e.diffusion + advection_rate(space_, samples, e.relative_velocity);
    if (!exchange_.none()) moments += e.exchange;
    e.rate = pack(e.mesh_velocity, moments);
    return e;
}

double MembraneDynamics::line_energy(const MembraneState& state) const {
    const MembraneEnergy edge = endoflow::line_energy(parameters_);
    return 2.0 * std::numbers::pi * energy_derivatives(space_, state, edge, Derivatives::first).energy;
}

double MembraneDynamics::exchanged_per_time(double time, const Eigen::VectorXd& y) const {
    if (exchange_.none()) return 0.0;
    const MembraneState state = unpack(y);
    const MembraneEnergy bending = bending_energy(parameters_, time);
    return 2.0 * std::numbers::pi * exchange_rate(space_, sample(space_, state), exchange_, bending).sum();
}

// With e = ½ β (κ − χC)² the derivative by χ is −C ∂e/∂κ.
double MembraneDynamics::maturation_power(const Evaluation& e) const {
    if (maturation_.none()) return 0.0;
    const MembraneEnergy bending = bending_energy(parameters_, e.time);
    const BendingModel matured(parameters_.membrane);
    double by_maturity = 0.0;
    for (std::size_t i = 0; i < e.samples.curve.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const double c = e.samples.c[i];
        const double by_curvature = bending.density(p.total_curvature(), c, 0.0).partial[local::curvature];
        by_maturity -= space_.weight[i] * p.r * p.g * matured.spontaneous_curvature(c).value * by_curvature;
    }
    return 2.0 * std::numbers::pi * by_maturity * maturation_.rate(e.time);
}

Eigen::MatrixXd MembraneDynamics::jacobian(const Evaluation& e) const {
    const Index curve = free_radial() + free_axial();
    const Index moments = space_.axial_count();
    const VelocityFreedoms& freedoms = e.operators->freedoms;
    Multipliers multipliers = e.flow.multipliers;
    multipliers.pressure -= loads_.pressure;
    const EnergyDerivatives second =
        energy_derivatives(space_, e.state, membrane_energy(parameters_, e.time), Derivatives::second, multipliers);

    // Velocity freedoms: δu = Y δload with B δu = - δB u.
    Eigen::MatrixXd load_curve = -freedoms.restrict_rows(pack_columns(second.hessian));
    Eigen::MatrixXd load_c = -freedoms.restrict_rows(second.mixed);
    if (loads_.carried()) {
        const CarriedLoadDerivatives pull = carried_load_derivatives(space_, e.samples, loads_);
        load_curve += freedoms.restrict_rows(pack_columns(pull.by_curve));
        load_c += freedoms.restrict_rows(pull.by_c);
    }
    Eigen::MatrixXd velocity_curve = e.operators->mobility * load_curve;
    Eigen::MatrixXd velocity_c = e.operators->mobility * load_c;
    if (flow_->constrained()) {
        const Eigen::MatrixXd constraint = flow_->constraint_matrix(e.samples, freedoms);
        const Eigen::MatrixXd response = e.operators->mobility * constraint.transpose();
        const LuFactors schur(constraint * response, "tension");
        const Eigen::MatrixXd variation = pack_columns(flow_->constraint_variation(e.samples, e.flow.velocity));
        velocity_curve -= response * schur.solve(constraint * velocity_curve + variation);
        velocity_c -= response * schur.solve(constraint * velocity_c);
    }
    const MeshMotion::Derivatives mesh = mesh_.derivatives(e.state, e.samples, e.flow.velocity, e.flow.inflow);
    // Variations of the tangential velocity of the mesh and of its whole velocity.
    const auto tangential = [&](const Eigen::MatrixXd& velocity, const Eigen::MatrixXd& direct) {
        Eigen::MatrixXd result = direct;
        if (freedoms.inflow) result.noalias() += mesh.by_inflow * velocity.row(space_.radial_count() - 1);
        if (mesh.by_velocity.size() > 0) result.noalias() += mesh.by_velocity * velocity;
        return result;
    };
    velocity_curve = freedoms.expand(velocity_curve);
    velocity_c = freedoms.expand(velocity_c);
    const Eigen::MatrixXd tangential_curve = tangential(velocity_curve, pack_columns(mesh.by_curve));
    const Eigen::MatrixXd tangential_c = tangential(velocity_c, mesh.by_concentration);
    const Eigen::MatrixXd rate_curve = pack_rows(velocity_curve + tangential_curve);
    const Eigen::MatrixXd rate_c = pack_rows(velocity_c + tangential_c);

    TransportDerivatives transport =
        transport_derivatives(space_, e.samples, e.state.c, transport_, second, e.relative_velocity);
    if (!exchange_.none()) {
        const MembraneEnergy bending = bending_energy(parameters_, e.time);
        const ExchangeDerivatives exchange = exchange_derivatives(space_, e.samples, exchange_, bending);
        transport.rate_from_c += exchange.from_c;
        transport.rate_from_curve += exchange.from_curve;
    }
    const Eigen::MatrixXd c_from_curve = pack_columns(transport.c_from_curve);
    const Eigen::MatrixXd advection = advection_from_mesh_velocity(space_, e.samples);
    const Eigen::MatrixXd moments_from_curve = pack_columns(transport.rate_from_curve) + advection * tangential_curve;
    const Eigen::MatrixXd moments_from_c = transport.rate_from_c + advection * tangential_c;
    Eigen::MatrixXd jacobian(size(), size());
    jacobian.topLeftCorner(curve, curve) = rate_curve + rate_c * c_from_curve;
    jacobian.topRightCorner(curve, moments) = rate_c * transport.c_from_moments;
    jacobian.bottomLeftCorner(moments, curve) = moments_from_curve + moments_from_c * c_from_curve;
    jacobian.bottomRightCorner(moments, moments) = moments_from_c * transport.c_from_moments;
    return jacobian;
}

Eigen::VectorXd MembraneDynamics::error_scales(const Eigen::VectorXd& y, double length, double concentration) const {
    const MembraneSamples samples = sample(space_, unpack(y));
    Eigen::VectorXd areas = surface_mass_matrix(space_, samples.curve) * Eigen::VectorXd::Ones(space_.axial_count());
    return pack(Eigen::VectorXd::Constant(space_.curve_count(), length), concentration * areas);
}

}  // namespace endoflow::boundary_integral
