// Molecules that come and go, and molecules that bending and line energy drive.

#include <catch2/catch.hpp>

#include "boundary_integral/driver/molecule_balance.h"
#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "curves.h"
#include "shared/geometry/observables.h"
#include "shared/model/time_scale.h"
#include "statics/sampled_curve.h"
#include "statics/stationary_state.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using endoflow::boundary_integral::testing::bulge;

using std::numbers::pi;

Parameters case_of(int elements) {
    Parameters parameters;
    parameters.boundary_integral.elements = elements;
    return parameters;
}

Parameters with_reservoir(Parameters parameters) {
    parameters.molecules.exchange = Exchange::reservoir;
    parameters.molecules.on_rate = 0.3;
    parameters.molecules.off_rate = 0.2;
    parameters.molecules.pool_area = 9000;
    return parameters;
}

Parameters with_edge_growth(Parameters parameters, double speed) {
    parameters.molecules.exchange = Exchange::edge;
    parameters.molecules.edge_speed = speed;
    return parameters;
}

Parameters coupled(Parameters parameters) {
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 80;
    parameters.molecules.mobility = 2000;
    parameters.membrane.spontaneous_curvature = 0.01;  // bending must not dissolve the edge
    parameters.membrane.bending_stiffness_coated = 150;
    return parameters;
}

/// A law that the engine has never heard of: molecules bring others, and bent membrane keeps them.
struct CooperativeExchange {
    template <class Number>
    [[nodiscard]] Number rate(const ExchangePoint<Number>& x) const {
        const Number& c = x.concentration;
        return 0.3 * (c * c * (1.0 - 1e-4 * x.mass)) - 0.1 * (x.by_concentration * c);
    }
};

Eigen::VectorXd waves(Index size, double phase) {
    Eigen::VectorXd result(size);
    for (Index i = 0; i < size; ++i) result[i] = std::sin(3.0 * static_cast<double>(i) + phase);
    return result;
}

// Follows the dynamics for a while; returns the last state.
Eigen::VectorXd followed(const MembraneDynamics& dynamics, double end, double longest, double tolerance,
                         const std::function<void(const StiffIntegrator&, const Evaluation&)>& look) {
    std::shared_ptr<const MobilityOperators> operators = dynamics.operators(dynamics.initial_vector());
    Evaluation latest;
    StiffProblem problem;
    problem.begin_step = [&](const Eigen::VectorXd& predicted) { operators = dynamics.operators(predicted); };
    problem.rate = [&](double /*time*/, const Eigen::VectorXd& y) {
        latest = dynamics.evaluate(0, y, operators);
        return latest.rate;
    };
    problem.jacobian = [&] { return dynamics.jacobian(latest); };
    problem.error_scales = dynamics.error_scales(dynamics.initial_vector(), tolerance, tolerance);
    StiffIntegrator integrator(problem, {0.0, 1e-5, dynamics.initial_vector()}, {longest, 1e-14});
    while (integrator.time() < end) {
        integrator.advance(end);
        look(integrator, dynamics.evaluate(0, integrator.state(), operators));
    }
    return integrator.state();
}

// A membrane whose coat does not bend it stays flat.
Parameters flat(Parameters parameters) {
    parameters.membrane.spontaneous_curvature = 0;
    parameters.molecules.transport = Transport::advection;
    return parameters;
}

double mass_of(const MembraneDynamics& dynamics, const Eigen::VectorXd& y) {
    return molecule_mass(dynamics.space(), sample(dynamics.space(), dynamics.unpack(y)));
}

// Of the stationary shape, by the boundary-value problem of statics/.
Observables at_rest(const Parameters& parameters) {
    const statics::StationaryState state = statics::find_stationary_state(parameters);
    const statics::GaussRule rule(statics::Resolution{}.points);
    return measure(statics::sampled_curve(parameters, state.point.solution, rule, 1001),
                   BendingModel(parameters.membrane));
}

double disc_mass(double radius) {
    const double width = std::sqrt(2.0) * 1.2;
    return pi * (radius * radius + pi * pi * width * width / 12);
}

}  // namespace

TEST_CASE("the derivatives of exchange are those of its rate", "[molecules]") {
    MoleculeParameters reservoir = with_reservoir({}).molecules, edge = with_edge_growth({}, 0.1).molecules;
    reservoir.pool_area = edge.pool_area = 9000;
    reservoir.curvature_sensing = 1, reservoir.molecule_area = 0.5;
    const ExchangeLaw law =
        GENERATE_COPY(values({exchange_law(reservoir), exchange_law(edge), ExchangeLaw(CooperativeExchange{})}));
    const MembraneEnergy bending = bending_energy(Parameters{});
    const MembraneSpace space(24, 8);
    MembraneState here = bulge(space, 25);
    here.c.array() += 0.05;  // away from the edge law's c = 0
    const ExchangeDerivatives exact = exchange_derivatives(space, sample(space, here), law, bending);
    const Eigen::VectorXd on_curve = waves(space.curve_count(), 1.0), on_c = waves(space.axial_count(), 2.0);
    const auto rate = [&](double curve, double c) {
        MembraneState moved = here;
        moved.r += curve * on_curve.head(space.radial_count());
        moved.z += curve * on_curve.tail(space.axial_count());
        moved.c += c * on_c;
        return exchange_rate(space, sample(space, moved), law, bending);
    };
    constexpr double step = 1e-5;  // central differences
    const Eigen::VectorXd by_curve = (rate(step, 0) - rate(-step, 0)) / (2 * step);
    const Eigen::VectorXd by_c = (rate(0, step) - rate(0, -step)) / (2 * step);
    CHECK((exact.from_curve * on_curve - by_curve).norm() < 1e-7 * by_curve.norm());
    CHECK((exact.from_c * on_c - by_c).norm() < 1e-7 * by_c.norm());
}

TEST_CASE("the Jacobian knows exchange and energetic coupling", "[molecules]") {
    const Parameters parameters = GENERATE(0, 1) == 0 ? coupled(case_of(24)) : with_reservoir(case_of(24));
    const MembraneDynamics dynamics(parameters);
    Eigen::VectorXd y = dynamics.initial_vector();
    for (int i = 0; i < 3; ++i) y += 1e-5 * dynamics.evaluate(0, y).rate.normalized();
    const auto operators = dynamics.operators(y);
    const Eigen::MatrixXd jacobian = dynamics.jacobian(dynamics.evaluate(0, y, operators));
    const Index moments = dynamics.space().axial_count(), curve = dynamics.size() - moments;
    const Eigen::VectorXd scales = dynamics.error_scales(y, 1, 1);
    for (const bool of_moments : {false, true}) {
        Eigen::VectorXd direction = waves(dynamics.size(), 1.0).cwiseProduct(scales);
        (of_moments ? direction.head(curve) : direction.tail(moments)).setZero();
        constexpr double step = 1e-6;
        const Eigen::VectorXd difference = (dynamics.evaluate(0, y + step * direction, operators).rate -
                                            dynamics.evaluate(0, y - step * direction, operators).rate) /
                                           (2 * step);
        const Eigen::VectorXd error = (jacobian * direction - difference).cwiseQuotient(scales);
        const Eigen::VectorXd size = difference.cwiseQuotient(scales);
        CAPTURE(of_moments, static_cast<int>(parameters.molecules.exchange));
        // as in the Jacobian's own test: the direct effect of the tangent's turning on the moments is left out
        CHECK(error.head(curve).norm() < 1e-5 * size.head(curve).norm());
        CHECK(error.tail(moments).norm() < (of_moments ? 1e-5 : 1e-3) * size.tail(moments).norm());
    }
}

TEST_CASE("c on a flat membrane relaxes to Langmuir's equilibrium at k_on + k_off", "[molecules]") {
    Parameters parameters = with_reservoir(flat(case_of(24)));
    parameters.molecules.pool_area = 0;
    const MembraneDynamics dynamics(parameters);
    MoleculeBalance balance;
    const double first = mass_of(dynamics, dynamics.initial_vector());
    balance.start(first);
    double before = 0, worst = 0;
    const Eigen::VectorXd y =
        followed(dynamics, 4, 0.2, 1e-4, [&](const StiffIntegrator& integrator, const Evaluation&) {
            balance.advance(before, integrator.time(),
                            [&](double t) { return dynamics.exchanged_per_time(t, integrator.state_at(t)); });
            before = integrator.time();
            worst = std::max(worst, balance.residual(mass_of(dynamics, integrator.state()), 0));
        });
    const double full = 0.6 * pi * 80 * 80, left = std::exp(-0.5 * 4.0);
    CHECK(mass_of(dynamics, y) == Approx(full + (first - full) * left).epsilon(1e-3));  // tolerance 1e-4 of c a step
    CHECK(worst < 1e-4);
}

// Molecules at rest: every point's c grows by itself, and what is ahead of the edge out of the tail of its profile.
// That tail must be right, so the tolerance is smaller than elsewhere: an error of 1e-6 there is an edge that is ε_c/√2
// ln(1e6) = 12 nm away.
TEST_CASE("the radius of a flat coat grows at the edge's speed", "[molecules]") {
    const MembraneDynamics dynamics(with_edge_growth(flat(case_of(80)), 1e-3));
    const Eigen::VectorXd y = followed(dynamics, 4000, 200, 1e-6, [](const StiffIntegrator&, const Evaluation&) {});
    CHECK(std::sqrt(mass_of(dynamics, y) / pi) == Approx(std::sqrt(disc_mass(40) / pi)).margin(2e-3));
}

// Molecules held together by (24): outside a round coat c = ε_c √2/(12 r_c), inside as much above 1, and the edge law
// acts on both. With fast diffusion dr_c/dt = v (1 + (R² − 2r_c²)/(12 r_c²)), whatever ε_c.
TEST_CASE("a flat coat that Cahn-Hilliard holds together grows faster by what it dissolves", "[molecules]") {
    Parameters parameters = with_edge_growth(flat(case_of(60)), 1e-3);
    parameters.molecules.transport = Transport::cahn_hilliard;
    const MembraneDynamics dynamics(parameters);
    const Eigen::VectorXd y = followed(dynamics, 4000, 200, 1e-4, [](const StiffIntegrator&, const Evaluation&) {});
    double radius = 36;
    for (int i = 0; i < 4000; ++i) radius += 1e-3 * (1 + (80 * 80 - 2 * radius * radius) / (12 * radius * radius));
    CHECK(radius - 36 > 4.7);  // against 4 without
    CHECK(std::sqrt(mass_of(dynamics, y) / pi) == Approx(std::sqrt(disc_mass(radius) / pi)).margin(0.05));
}

TEST_CASE("what drives molecules and membrane is one energy", "[molecules]") {
    const MembraneDynamics dynamics(coupled(case_of(60)));
    double energy = std::numeric_limits<double>::infinity();
    double dissipated = 0;
    followed(dynamics, 0.02, 0.01, 1e-4, [&](const StiffIntegrator&, const Evaluation& e) {
        const EnergyBalance balance = energy_balance(dynamics, e);
        CHECK(balance.residual() < 1e-5);
        CHECK(balance.molecular_dissipation > 0);
        CHECK(balance.energy < energy * (1 + 1e-9));
        dissipated += balance.molecular_dissipation;
        energy = balance.energy;
        // What diffusion brings is what it dissipates, but for what the weak incompressibility lets through.
        CHECK(balance.diffusive_power ==
              Approx(-balance.molecular_dissipation).margin(1e-3 * balance.dissipated_power));
    });
    CHECK(dissipated > 0);
}

TEST_CASE("the force of the coat's edge is minus the variation of its energy", "[molecules]") {
    const MembraneSpace space(24, 8);
    const MembraneState state = bulge(space, 25);
    const MembraneEnergy edge = line_energy(coupled({}));
    const EnergyDerivatives exact = energy_derivatives(space, state, edge, Derivatives::first);
    const Eigen::VectorXd direction = waves(space.curve_count(), 1.0);
    const auto energy = [&](double amount) {
        MembraneState moved = state;
        moved.r += amount * direction.head(space.radial_count());
        moved.z += amount * direction.tail(space.axial_count());
        return energy_derivatives(space, moved, edge, Derivatives::first).energy;
    };
    constexpr double step = 1e-4;
    const double error = exact.gradient.dot(direction) - (energy(step) - energy(-step)) / (2 * step);
    CHECK(std::abs(error) < 1e-8 * exact.gradient.norm() * direction.norm());  // of terms that nearly cancel here
}

// 10 ms in steps of the growth's size: at its end the membrane is where a stationary shape of as much coat is, though
// neither knows of the other. 5e-4: 40 elements on a coat's edge of 1.7 nm.
TEST_CASE("a membrane follows a slowly growing coat through stationary shapes", "[molecules]") {
    Parameters parameters = with_edge_growth(case_of(40), 2e-4);
    parameters.molecules.patch_radius = 20;
    parameters.membrane.rim_tension = 0.2;
    const MembraneDynamics dynamics(parameters);
    int steps = 0;
    const Eigen::VectorXd y = followed(dynamics, 1e4, longest_step(parameters), 1e-4,
                                       [&](const StiffIntegrator&, const Evaluation&) { ++steps; });
    const ShapeMeasures grown = measure_shape(dynamics.space(), dynamics.unpack(y), parameters.domain);
    CHECK(steps < 400);
    parameters.molecules.exchange = Exchange::none;
    parameters.molecules.patch_radius = std::sqrt(mass_of(dynamics, y) / pi - (disc_mass(0) / pi));
    CHECK(parameters.molecules.patch_radius > 20.5);
    const Observables seen = at_rest(parameters);
    CHECK(grown.bud_height == Approx(seen.bud_height).epsilon(5e-4));
    CHECK(grown.membrane_area == Approx(seen.membrane_area).epsilon(5e-5));
}

TEST_CASE("coupled molecules and membrane come to rest where statics says", "[molecules]") {
    Parameters parameters = coupled(case_of(60));
    parameters.molecules.line_energy = 40;
    parameters.membrane.rim_tension = 0.05;
    const MembraneDynamics dynamics(parameters);
    const Eigen::VectorXd y = followed(dynamics, 60, 5, 1e-4, [](const StiffIntegrator&, const Evaluation&) {});
    const ShapeMeasures rest = measure_shape(dynamics.space(), dynamics.unpack(y), parameters.domain);
    const Observables seen = at_rest(parameters);
    // after 60 µs the height still lacks 3e-5 of itself
    CHECK(rest.bud_height == Approx(seen.bud_height).epsilon(1e-4));
    CHECK(rest.membrane_area == Approx(seen.membrane_area).epsilon(1e-5));
    CHECK(rest.extracellular_volume == Approx(seen.extracellular_volume).epsilon(1e-4));
}
