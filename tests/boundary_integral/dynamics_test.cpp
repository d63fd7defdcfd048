// The membrane as a system of ordinary differential equations: conservation, Jacobian, energy balance.

#include <catch2/catch.hpp>
#include <numbers>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/flow/free_space_flow.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using endoflow::boundary_integral::testing::bulge;
using std::numbers::pi;

Parameters small_case() {
    Parameters parameters;
    parameters.boundary_integral.elements = 24;
    return parameters;
}

Parameters with_loads(Parameters parameters) {
    parameters.membrane.rim_tension = 0.05;
    parameters.fluid.pressure_difference = 1e-3;
    parameters.membrane.pole_force = 20;
    parameters.membrane.coat_force = 30;
    parameters.membrane.coat_force_ring = {42, 70};
    parameters.membrane.collar_force = 15;
    parameters.membrane.collar_position = 50;
    return parameters;
}

// A state some way into the motion, by explicit Euler steps that an unstiff observer would call tiny.
Eigen::VectorXd moved(const MembraneDynamics& dynamics) {
    Eigen::VectorXd y = dynamics.initial_vector();
    for (int i = 0; i < 3; ++i) y += 1e-7 * dynamics.evaluate(0, y).rate;
    return y;
}

}  // namespace

TEST_CASE("the initial membrane is flat, resolves the coat and holds its molecules", "[dynamics]") {
    Parameters parameters;
    parameters.boundary_integral.elements = 60;
    const MembraneDynamics dynamics(parameters);
    const Eigen::VectorXd y = dynamics.initial_vector();
    const MembraneState state = dynamics.unpack(y);
    const ShapeMeasures shape = measure_shape(dynamics.space(), state, DomainParameters{});
    CHECK(shape.membrane_area == Approx(pi * 80 * 80).epsilon(1e-12));
    // int c dA of the tanh profile: pi r_c^2 (1 + pi^2 (sqrt2 eps)^2 / (12 r_c^2)), up to exp(-2 r_c / (sqrt2 eps)) =
    // 4e-19.
    const double width = std::sqrt(2.0) * 1.2, patch = 36;
    // 1e-6: what 60 elements resolve of a 1.7 nm wide edge
    CHECK(molecule_mass(dynamics.space(), sample(dynamics.space(), state)) ==
          Approx(pi * patch * patch * (1 + pi * pi * width * width / (12 * patch * patch))).epsilon(1e-6));
}

TEST_CASE("the molecules' mass does not change", "[dynamics]") {
    const auto law = GENERATE(Transport::cahn_hilliard, Transport::fickian, Transport::advection);
    Parameters parameters = small_case();
    parameters.molecules.transport = law;
    const MembraneDynamics dynamics(parameters);
    const Evaluation e = dynamics.evaluate(0, moved(dynamics));
    const Eigen::VectorXd rate = e.rate.tail(dynamics.space().axial_count());
    // The sum over the moments telescopes; only round-off is left of rates of this size.
    CHECK(std::abs(rate.sum()) < 1e-12 * rate.cwiseAbs().sum());
}

TEST_CASE("the energy's rate is minus the dissipated power plus diffusion plus the loads' power", "[dynamics]") {
    const bool loaded = GENERATE(false, true);
    const MembraneDynamics dynamics(loaded ? with_loads(small_case()) : small_case());
    const EnergyBalance balance = energy_balance(dynamics, dynamics.evaluate(0, moved(dynamics)));
    CHECK((balance.external_power != 0) == loaded);
    CHECK(balance.dissipated_power > 0);
    CHECK(balance.energy_rate < 0);
    CHECK(balance.residual() < 1e-4);  // mesh motion is no motion: interpolation error of the moving coat edge
}

TEST_CASE("the Jacobian is the derivative of the rate at fixed operators", "[dynamics]") {
    Parameters parameters = small_case();
    const auto [dynamics_kind, domain_kind, inextensible] =
        GENERATE(std::tuple(Dynamics::flow, DomainKind::box, true), std::tuple(Dynamics::flow, DomainKind::box, false),
                 std::tuple(Dynamics::geometric, DomainKind::box, false),
                 std::tuple(Dynamics::flow, DomainKind::free_space, true));
    parameters.fluid.dynamics = dynamics_kind;
    parameters.domain.kind = domain_kind;
    parameters.membrane.inextensible = inextensible;
    const bool loaded = inextensible && domain_kind == DomainKind::box;
    const MembraneDynamics dynamics(loaded ? with_loads(parameters) : parameters);
    // Off the initial state, where the mesh is at rest and many terms vanish.
    Eigen::VectorXd y = dynamics.initial_vector();
    for (int i = 0; i < 3; ++i) y += 1e-5 * dynamics.evaluate(0, y).rate.normalized();
    const auto operators = dynamics.operators(y);
    const Eigen::VectorXd scales = dynamics.error_scales(y, 1, 1);
    const Eigen::MatrixXd jacobian = scales.cwiseInverse().asDiagonal() *
                                     dynamics.jacobian(dynamics.evaluate(0, y, operators)) * scales.asDiagonal();
    Eigen::MatrixXd difference(dynamics.size(), dynamics.size());
    for (Index j = 0; j < dynamics.size(); ++j) {
        const double step = 1e-5 * scales[j];
        Eigen::VectorXd up = y, down = y;
        up[j] += step;
        down[j] -= step;
        difference.col(j) = (dynamics.evaluate(0, up, operators).rate - dynamics.evaluate(0, down, operators).rate)
                                .cwiseQuotient(scales) /
                            2e-5;
    }
    const Index curve = dynamics.size() - dynamics.space().axial_count();
    const Index moments = dynamics.space().axial_count();
    const auto relative = [&](Index i, Index j, Index rows, Index columns) {
        return (jacobian - difference).block(i, j, rows, columns).norm() / difference.block(i, j, rows, columns).norm();
    };
    CAPTURE(static_cast<int>(dynamics_kind), static_cast<int>(domain_kind), inextensible);
    // Central differences: (1e-5)^2 times third derivatives, and round-off of rates ~ 1e5 in steps of 1e-5.
    CHECK(relative(0, 0, curve, curve) < 1e-5);
    CHECK(relative(0, curve, curve, moments) < 1e-5);
    // The mesh's motion is tangential up to its interpolation: the direct effect of the tangent's turning is left out.
    CHECK(relative(curve, 0, moments, curve) < 1e-3);
    CHECK(relative(curve, curve, moments, moments) < 1e-5);
}

TEST_CASE("without a fluid the energy falls by what normal motion gains", "[dynamics]") {
    Parameters parameters = small_case();
    parameters.fluid.dynamics = Dynamics::geometric;
    const MembraneDynamics dynamics(parameters);
    const Evaluation e = dynamics.evaluate(0, moved(dynamics));
    CHECK(e.flow.power > 0);
    // Along the material's motion alone: exact by construction, round-off of a sum of terms ~ 1e3 larger.
    const double rate = 2.0 * pi * e.energy.gradient.dot(e.flow.velocity);
    CHECK(rate == Approx(-e.flow.power).epsilon(1e-9));
    // Every point moves along its normal, up to what the splines can represent.
    double normal = 0, tangential = 0;
    const MembraneSpace& space = dynamics.space();
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = e.samples.curve[i];
        const double u_r = space.radial_rows[i].evaluate(e.flow.velocity.head(space.radial_count()));
        const double u_z = space.axial_rows[i].evaluate(e.flow.velocity.tail(space.axial_count()));
        normal += space.weight[i] * std::pow(u_r * p.normal_r + u_z * p.normal_z, 2);
        tangential += space.weight[i] * std::pow(u_r * p.r1 + u_z * p.z1, 2) / (p.g * p.g);
    }
    CHECK(tangential < 1e-6 * normal);
}

TEST_CASE("a vesicle in free space keeps area and volume and has no net force", "[dynamics]") {
    Parameters parameters = small_case();
    parameters.domain.kind = DomainKind::free_space;
    parameters.molecules.patch_radius = 1e4;
    parameters.fluid.viscosity_extracellular = GENERATE(1e-3, 1e-2);
    const MembraneDynamics dynamics(parameters);
    const Eigen::VectorXd y = dynamics.initial_vector();
    const ShapeMeasures shape = measure_shape(dynamics.space(), dynamics.unpack(y), parameters.domain);
    const double a = parameters.domain.spheroid_equatorial_axis, b = parameters.domain.spheroid_polar_axis;
    const double eccentricity = std::sqrt(1 - a * a / (b * b));
    // 24 quintic elements
    CHECK(shape.extracellular_volume == Approx(4 * pi / 3 * a * a * b).epsilon(1e-7));
    CHECK(shape.membrane_area == Approx(2 * pi * a * (a + b * std::asin(eccentricity) / eccentricity)).epsilon(1e-7));
    CHECK(shape.bud_height == Approx(2 * b).epsilon(1e-9));
    const Evaluation e = dynamics.evaluate(0, y);
    // coated everywhere
    CHECK(molecule_mass(dynamics.space(), e.samples) == Approx(shape.membrane_area).epsilon(1e-12));
    const FlowBalances balances = flow_balances(dynamics.space(), *e.operators, e.samples, e.flow);
    CHECK(balances.net_flux < 1e-12);
    CHECK(balances.area < 1e-9);
    CHECK(balances.force < 1e-12);
    CHECK(energy_balance(dynamics, e).residual() < 1e-9);
    CHECK(e.flow.power > 0);
}

// The power of a unit motion upwards.
double total_force(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    return 2.0 * pi * external_load(space, samples, loads).tail(space.axial_count()).sum();
}

TEST_CASE("the pole force adds up to F, that on the coat to F_a, and with a ring to nothing", "[dynamics][loads]") {
    const MembraneSpace space(24, 8);
    const MembraneSamples samples = sample(space, bulge(space, 25));
    Parameters pole, coat, ringed;
    pole.membrane.pole_force = 20;
    coat.membrane.coat_force = ringed.membrane.coat_force = 30;
    ringed.membrane.coat_force_ring = {42, 70};
    CHECK(total_force(space, samples, loads_of(pole)) == Approx(20).epsilon(1e-6));  // the quadrature of the density
    CHECK(total_force(space, samples, loads_of(coat)) == Approx(30).epsilon(1e-13));
    CHECK(std::abs(total_force(space, samples, loads_of(ringed))) < 30 * 1e-6);
}

TEST_CASE("a force on a coat that is all in the spot is the pole force", "[dynamics][loads]") {
    const MembraneSpace space(24, 8);
    Parameters pole, coat;
    pole.membrane.pole_force = coat.membrane.coat_force = 20;
    const Loads on_pole = loads_of(pole);
    // The flat membrane, with c in proportion to the spot's density.
    const double radius = pole.domain.radius;
    MembraneSamples samples = sample(space, state_of(
                                                space, [&](double x) { return radius * x; },
                                                [](double) { return 80.0; }, [](double) { return 0.0; }));
    for (std::size_t i = 0; i < samples.c.size(); ++i)
        samples.c[i] = 7 * on_pole.force_share(pi * samples.curve[i].r * samples.curve[i].r);
    const Eigen::VectorXd expected = external_load(space, samples, on_pole),
                          found = external_load(space, samples, loads_of(coat));
    CHECK((found - expected).norm() < 1e-6 * expected.norm());  // the quadrature of the density
}

TEST_CASE("carried loads vary with the membrane and its molecules", "[dynamics][loads]") {
    Parameters parameters = small_case();
    parameters.membrane.pole_force = 20;
    parameters.membrane.coat_force = 30;
    parameters.membrane.coat_force_ring = {42, 70};
    parameters.membrane.collar_force = 15;
    parameters.membrane.collar_position = 50;
    const Loads loads = loads_of(parameters);
    const MembraneSpace space(24, 8);
    const MembraneState state = bulge(space, 25);
    const CarriedLoadDerivatives exact = carried_load_derivatives(space, sample(space, state), loads);
    Eigen::VectorXd direction(space.curve_count());
    for (Index i = 0; i < direction.size(); ++i) direction[i] = std::sin(3.0 * static_cast<double>(i) + 1.0);
    const auto displaced = [&](double amount) {
        MembraneState moved = state;
        moved.r += amount * direction.head(space.radial_count());
        moved.z += amount * direction.tail(space.axial_count());
        return external_load(space, sample(space, moved), loads);
    };
    const auto coated = [&](double amount) {
        MembraneState moved = state;
        moved.c += amount * direction.tail(space.axial_count());
        return external_load(space, sample(space, moved), loads);
    };
    constexpr double step = 1e-5;
    const Eigen::VectorXd by_curve = (displaced(step) - displaced(-step)) / (2.0 * step),
                          by_c = (coated(step) - coated(-step)) / (2.0 * step);
    CHECK((exact.by_curve * direction - by_curve).norm() < 1e-7 * by_curve.norm());
    CHECK((exact.by_c * direction.tail(space.axial_count()) - by_c).norm() < 1e-7 * by_c.norm());
}

TEST_CASE("the round-off of a membrane at rest is no flux out of balance", "[dynamics][loads]") {
    const MembraneDynamics dynamics(small_case());
    Evaluation e = dynamics.evaluate(0, moved(dynamics));
    for (Index i = 0; i < e.flow.velocity.size(); ++i)
        e.flow.velocity[i] = 1e-11 * std::sin(3.0 * static_cast<double>(i));  // solves no equation
    e.flow.force.setZero();
    e.flow.inflow = 1e-12;
    const FlowBalances balances =
        flow_balances(dynamics.space(), *dynamics.box(), *e.operators, e.samples, e.flow, rest_level(small_case()));
    // 1e-11 nm/us against a speed of rest of 3e-5: areas of 80 nm² against 14², volumes of 80² against 14²
    CHECK(balances.net_flux < 1e-4);
    CHECK(balances.area < 1e-4);
}
