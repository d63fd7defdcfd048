// The linearisation about a moving state: against finite differences of the axisymmetric engine (m = 0), and against
// what a displaced and a tilted vesicle must do (m = 1).

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/modes/base_trajectory.h"
#include "boundary_integral/modes/perturbations.h"
#include "curves.h"
#include "modes_states.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

// Displacement along the normal, and concentration, in the spaces of mode 0.
struct AxisymmetricPerturbation {
    Profile w, c;
};

Eigen::VectorXd perturbed(const MembraneDynamics& dynamics, const MembraneState& state,
                          const AxisymmetricPerturbation& by, double amount) {
    const MembraneSpace& space = dynamics.space();
    const auto point = [&](double x) { return curve_point(space.radial().basis(x), space.axial().basis(x), state); };
    MembraneState moved = state_of(
        space, [&](double x) { return point(x).r + amount * by.w(x) * point(x).normal_r; },
        [&](double x) { return point(x).z + amount * by.w(x) * point(x).normal_z; },
        [&](double x) { return space.axial().basis(x).evaluate(state.c) + amount * by.c(x); });
    moved.r[space.radial_count() - 1] = state.r[space.radial_count() - 1];
    moved.z.tail(2) = state.z.tail(2);
    return dynamics.packed(moved);
}

Eigen::VectorXd concentration_rate(const MembraneDynamics& dynamics, const Evaluation& e) {
    return concentration_from_moments(dynamics.space(), e.samples.curve, moments_of_concentration_rate(dynamics, e));
}

}  // namespace

namespace {

// What of the model a membrane has beside bending.
using Part = void (*)(Parameters&);

void bears_loads(Parameters& p) {
    p.membrane.rim_tension = 0.3;
    p.fluid.pressure_difference = 0.02;
}

void is_coupled(Parameters& p) {
    p.membrane.rim_tension = 0.1;
    p.molecules.coupling = Coupling::energetic;
    p.molecules.line_energy = 60;
    p.molecules.mobility = 2000;
}

void exchanges_with_reservoir(Parameters& p) {
    p.molecules.exchange = Exchange::reservoir;
    p.molecules.on_rate = 200;
    p.molecules.off_rate = 100;
    p.molecules.curvature_sensing = 1;
    p.molecules.molecule_area = 0.5;
}

void grows_at_the_edge(Parameters& p) {
    p.molecules.transport = Transport::advection;
    p.molecules.exchange = Exchange::edge;
    p.molecules.edge_speed = 1000;
}

}  // namespace

TEST_CASE("mode 0 of the linearisation is the derivative of the axisymmetric engine", "[modes]") {
    Parameters parameters;
    parameters.boundary_integral.elements = 40;
    parameters.molecules.interface_width = 6;
    GENERATE(values<Part>({[](Parameters&) {}, [](Parameters& p) { p.molecules.transport = Transport::fickian; },
                           bears_loads, is_coupled, exchanges_with_reservoir, grows_at_the_edge}))
    (parameters);
    parameters.boundary_integral.mesh_relaxation_time =
        0.5;  // this curve is no run's: its mesh is far from the wanted one
    const MembraneDynamics dynamics(parameters);
    const MembraneSpace& space = dynamics.space();
    const MembraneState state = bulge(space, 25);
    const Evaluation e = dynamics.evaluate(0, dynamics.packed(state));
    const Surroundings surroundings(parameters, space, 0);
    const LinearisedMembrane membrane(parameters, surroundings, base_state(dynamics, e));

    const AxisymmetricPerturbation by = {[](double x) { return std::pow(1 - x * x, 3) * std::cos(4 * x * x); },
                                         [](double x) { return 0.3 * std::exp(-6 * x * x); }};
    const double step = 1e-4;
    const Evaluation plus = dynamics.evaluate(0, perturbed(dynamics, state, by, step));
    const Evaluation minus = dynamics.evaluate(0, perturbed(dynamics, state, by, -step));
    // Rates of what the mesh's points do; c' is compared at the same place along the normal.
    const auto c_rate = [&](const Evaluation& at) { return concentration_rate(dynamics, at); };
    const Eigen::VectorXd curve = (plus.mesh_velocity - minus.mesh_velocity) / (2 * step);
    const Eigen::VectorXd c = (c_rate(plus) - c_rate(minus)) / (2 * step);

    const ModeSpace& mode = surroundings.space(0);
    const ModeRates rates = membrane.rates(0);
    std::vector<double> speed;
    for (const double v : e.relative_velocity) speed.push_back(-v);
    const Eigen::MatrixXd matrix = rates.material + membrane.carrying(0, speed);
    const Eigen::VectorXd w0 = spline_of(mode.vertical(), by.w).head(rates.displacements);
    const Eigen::VectorXd c0 = spline_of(mode.vertical(), by.c);
    Eigen::VectorXd y(matrix.cols());
    y << w0, c0;
    const Eigen::VectorXd rate = matrix * y;
    Eigen::VectorXd w_rate = Eigen::VectorXd::Zero(space.axial_count());
    w_rate.head(rates.displacements) = rate.head(rates.displacements);

    double w_error = 0, w_scale = 0, c_error = 0, c_scale = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const double v_r = space.radial_rows[i].evaluate(curve.head(space.radial_count()));
        const double v_z = space.axial_rows[i].evaluate(curve.tail(space.axial_count()));
        // x = X + w n + tau t, so that t.dx/dt = d tau/dt + w t.dn/dt, and the normal turns with the mesh.
        const double turning =
            (p.normal_r * space.radial_rows[i].evaluate(e.mesh_velocity.head(space.radial_count()), 1) +
             p.normal_z * space.axial_rows[i].evaluate(e.mesh_velocity.tail(space.axial_count()), 1)) /
            p.g;
        const double along = (v_r * p.r1 + v_z * p.z1) / p.g + by.w(space.xi[i]) * turning;
        const double normal = v_r * p.normal_r + v_z * p.normal_z;
        const double of_c = space.axial_rows[i].evaluate(c) - along * e.samples.c1[i] / p.g;
        const double area = space.weight[i] * p.r * p.g;
        w_error += area * std::pow(space.axial_rows[i].evaluate(w_rate) - normal, 2);
        w_scale += area * normal * normal;
        c_error += area * std::pow(space.axial_rows[i].evaluate(rate.tail(space.axial_count())) - of_c, 2);
        c_scale += area * of_c * of_c;
    }
    CAPTURE(w_error, w_scale, c_error, c_scale);
    CHECK(std::sqrt(w_error / w_scale) < 1e-4);
    CHECK(std::sqrt(c_error / c_scale) < 1e-4);
}

TEST_CASE("the propagator of mode 0 is the difference of two nearby runs", "[modes]") {
    Parameters parameters;
    parameters.boundary_integral.elements = 40;
    parameters.molecules.interface_width = 6;
    const MembraneDynamics dynamics(parameters);
    const MembraneSpace& space = dynamics.space();
    const Eigen::VectorXd start = dynamics.initial_vector();
    const MembraneState state = dynamics.unpack(start);
    // Errors of the runs (1e-8 a step) and the third-order part (1e-4 of the bud's size, squared) stay below 1e-5.
    constexpr double end = 0.05, tolerance = 1e-8, amount = 0.01;
    const AxisymmetricPerturbation by = {[](double x) { return std::pow(1 - x * x, 3) * std::cos(4 * x * x); },
                                         [](double x) { return 0.03 * std::exp(-6 * x * x); }};
    const auto run = [&](const Eigen::VectorXd& from) {
        return BaseTrajectory(dynamics, parameters, {from, end, tolerance});
    };
    const BaseTrajectory base = run(start);
    const MembraneState plus = dynamics.unpack(run(perturbed(dynamics, state, by, amount)).state(end));
    const MembraneState minus = dynamics.unpack(run(perturbed(dynamics, state, by, -amount)).state(end));

    const Surroundings surroundings(parameters, space, 0);
    const ModeSpace& mode = surroundings.space(0);
    const auto rates = [&](double time) {
        const Evaluation e = dynamics.evaluate(0, base.state(time));
        const LinearisedMembrane membrane(parameters, surroundings, base_state(dynamics, e));
        return std::vector<LinearRate>{mesh_rate(membrane, mode, membrane.rates(0), e.relative_velocity, 1.0)};
    };
    Eigen::MatrixXd y(mode.displacement_count() + mode.scalar().dimension(), 1);
    y << spline_of(mode.vertical(), by.w).head(mode.displacement_count()), spline_of(mode.vertical(), by.c);
    LinearPropagation propagation(rates, 0.0, {y}, 1e-7, 1e-4);
    propagation.advance(end);
    const Eigen::VectorXd reached = propagation.values()[0];
    Eigen::VectorXd w = Eigen::VectorXd::Zero(space.axial_count());
    w.head(mode.displacement_count()) = reached.head(mode.displacement_count());
    const Eigen::VectorXd c = reached.tail(space.axial_count());

    const MembraneState at_end = dynamics.unpack(base.state(end));
    const MembraneSamples samples = sample(space, at_end);
    double w_error = 0, w_scale = 0, c_error = 0, c_scale = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow &radial = space.radial_rows[i], &axial = space.axial_rows[i];
        const double dr = radial.evaluate(plus.r - minus.r) / (2 * amount);
        const double dz = axial.evaluate(plus.z - minus.z) / (2 * amount);
        const double dc = axial.evaluate(plus.c - minus.c) / (2 * amount);
        const double normal = dr * p.normal_r + dz * p.normal_z;
        const double of_c = dc - (dr * p.r1 + dz * p.z1) / p.g * samples.c1[i] / p.g;  // at the same place
        const double area = space.weight[i] * p.r * p.g;
        w_error += area * std::pow(axial.evaluate(w) - normal, 2);
        w_scale += area * normal * normal;
        c_error += area * std::pow(axial.evaluate(c) - of_c, 2);
        c_scale += area * of_c * of_c;
    }
    CAPTURE(std::sqrt(w_error / w_scale), std::sqrt(c_error / c_scale), propagation.steps(), base.steps());
    CHECK(std::sqrt(w_error / w_scale) < 1e-4);
    CHECK(std::sqrt(c_error / c_scale) < 1e-4);
}

namespace {

// Normal displacement and concentration of a rigid motion: w = eta.n, c' = -(eta.t) c_s, and their rates of change in
// coordinates that move along the normal. `motion` gives (eta_r, eta_z) at a point and its own velocity.
struct RigidMotion {
    double r, z;
};
using Motion = RigidMotion (*)(const CurvePoint&);

// Largest error of L y against dy/dt, relative to the largest rate, for a prolate vesicle on its way.
struct RigidErrors {
    double w, c;
};

RigidErrors rigid_errors(Motion motion, double inner, double outer, Index elements) {
    Parameters parameters = vesicle_parameters(inner, outer);
    parameters.boundary_integral.elements = static_cast<int>(elements);
    parameters.molecules.transport = Transport::advection;
    parameters.boundary_integral.mesh_relaxation_time = 1e3;  // the mesh follows the material
    const MembraneDynamics dynamics(parameters);
    const MembraneSpace& space = dynamics.space();
    using std::numbers::pi;
    const MembraneState state = state_of(
        space, [](double x) { return 18 * std::sin(pi * x) * (1 + 0.05 * std::cos(2 * pi * x)); },
        [](double x) { return 24 * std::cos(pi * x) + std::cos(2 * pi * x); },
        [](double x) { return 0.4 + 0.3 * std::cos(pi * x); });
    const Evaluation e = dynamics.evaluate(0, dynamics.packed(state));
    const Surroundings surroundings(parameters, space, 1);
    const LinearisedMembrane membrane(parameters, surroundings, base_state(dynamics, e));
    const ModeSpace& mode = surroundings.space(1);

    // The same quantities of the shape and of the shape a moment later, both in coordinates along the normal.
    const auto of_shape = [&](const MembraneState& at) {
        const auto values = [&](bool concentration) {
            std::vector<double> result;
            for (const double xi : mode.vertical().greville_points()) {
                const BasisRow axial = space.axial().basis(xi);
                const CurvePoint p = curve_point(space.radial().basis(xi), axial, at);
                const RigidMotion eta = motion(p);
                const double c_s = axial.evaluate(at.c, 1) / p.g;
                result.push_back(concentration ? -(eta.r * p.r1 + eta.z * p.z1) / p.g * c_s
                                               : eta.r * p.normal_r + eta.z * p.normal_z);
            }
            return interpolate(mode.vertical(), result);
        };
        Eigen::VectorXd y(2 * mode.vertical().dimension());
        y << values(false), values(true);
        return y;
    };
    const double step = 1e-5 / e.mesh_velocity.cwiseAbs().maxCoeff();
    const Eigen::VectorXd c_rate = concentration_rate(dynamics, e);
    const auto later = [&](double t) {
        return MembraneState{state.r + t * e.mesh_velocity.head(space.radial_count()),
                             state.z + t * e.mesh_velocity.tail(space.axial_count()), state.c + t * c_rate};
    };
    const Eigen::VectorXd expected = (of_shape(later(step)) - of_shape(later(-step))) / (2 * step);
    std::vector<double> speed;
    for (const double v : e.relative_velocity) speed.push_back(-v);
    const Eigen::VectorXd rate = (membrane.rates(1).material + membrane.carrying(1, speed)) * of_shape(state);
    const Index n = mode.vertical().dimension();
    return {(rate - expected).head(n).cwiseAbs().maxCoeff() / expected.head(n).cwiseAbs().maxCoeff(),
            (rate - expected).tail(n).cwiseAbs().maxCoeff() / expected.tail(n).cwiseAbs().maxCoeff()};
}

}  // namespace

namespace {

// Sizes of the two smallest rates of m = 1, translation and tilt, and of the next one, of a prolate vesicle at rest.
struct SlowestRates {
    double translation, tilt, physical;
};

SlowestRates of_resting_vesicle(Index elements) {
    Parameters parameters = vesicle_parameters(1e-3, 1e-2);
    parameters.boundary_integral.elements = static_cast<int>(elements);
    parameters.membrane.spontaneous_curvature = 0;
    parameters.membrane.bending_stiffness_coated = parameters.membrane.bending_stiffness;
    parameters.molecules.transport = Transport::advection;
    parameters.molecules.patch_radius = 1e3;  // nm, all of it: elements crowd at the edge of a smaller coat
    parameters.time.max_step = 0.2;  // µs: what the iteration leaves in a longer one is a velocity of 5e-9 nm/µs
    const MembraneDynamics dynamics(parameters);
    constexpr double at_rest_from = 150;  // µs; the slowest shape relaxes at 0.28/µs
    const BaseTrajectory relaxation(dynamics, parameters, {dynamics.initial_vector(), at_rest_from, 1e-6});
    const Evaluation e = dynamics.evaluate(0, relaxation.state(at_rest_from));
    REQUIRE(e.flow.velocity.cwiseAbs().maxCoeff() < 1e-9);
    const Surroundings surroundings(parameters, dynamics.space(), 1);
    const LinearisedMembrane membrane(parameters, surroundings, base_state(dynamics, e));
    const ModeRates rates = membrane.rates(1);
    const Eigen::MatrixXd block = rates.material.topLeftCorner(rates.displacements, rates.displacements);
    const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(block, false).eigenvalues();
    Eigen::VectorXd sizes = values.cwiseAbs();
    std::sort(sizes.begin(), sizes.end());
    return {sizes[0], sizes[1], sizes[2]};
}

}  // namespace

TEST_CASE("a vesicle at rest neither moves nor turns", "[modes]") {
    const SlowestRates rates = of_resting_vesicle(24);
    CAPTURE(rates.translation, rates.tilt, rates.physical);
    // Errors of the discretisation: 4e-13 and 1.3e-11 with 24 elements, 2e-13 and 2e-12 with 30. A coat's edge that 30
    // elements do not resolve makes the mesh rough: then they are 4e-8 and 9e-6.
    CHECK(rates.translation < 1e-8 * rates.physical);
    CHECK(rates.tilt < 1e-8 * rates.physical);
}

TEST_CASE("a displaced or tilted vesicle moves as the axisymmetric one does", "[modes]") {
    const auto [inner, outer] = GENERATE(std::pair(1e-3, 1e-3), std::pair(1e-2, 1e-3), std::pair(1e-3, 1e-2));
    const Motion motion = GENERATE(Motion([](const CurvePoint&) {
                                       return RigidMotion{1.0, 0.0};
                                   }),
                                   Motion([](const CurvePoint& p) {
                                       return RigidMotion{p.z, -p.r};
                                   }));
    const RigidErrors coarse = rigid_errors(motion, inner, outer, 24);
    const RigidErrors fine = rigid_errors(motion, inner, outer, 32);
    CAPTURE(inner, outer, coarse.w, coarse.c, fine.w, fine.c);
    // A force is a fourth derivative of the shape: quintic splines give order 4 at least.
    CHECK(fine.w < 2e-4);
    CHECK(fine.c < 2e-4);
    CHECK(std::log(coarse.w / fine.w) / std::log(32.0 / 24.0) > 4);
    CHECK(std::log(coarse.c / fine.c) / std::log(32.0 / 24.0) > 4);
}
