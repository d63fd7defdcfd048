// Velocity and pressure off the membrane: a drop with its exact solution, then the box.

#include <catch2/catch.hpp>
#include <numbers>

#include "boundary_integral/fields/flow_field.h"
#include "boundary_integral/flow/box_flow.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;

// Hadamard and Rybczynski: sphere of radius 1, force density z n (buoyancy), viscosities `inner`, `outer`.
struct Drop {
    double inner, outer;
    double force = 4 * pi / 3;
    double speed = force * (inner + outer) / (2 * pi * outer * (2 * outer + 3 * inner));
    double stokeslet = force / (8 * pi * outer);
    double dipole = speed / 2 - stokeslet;
    double vortex = 2 * stokeslet - 1.5 * speed;

    // Inside u = (speed - vortex) e_z + vortex (2 |x|^2 e_z - z x), p = 10 inner vortex z;
    // outside Stokeslet and dipole, p = force z / (4 pi |x|^3).
    FieldValue at(double r, double z) const {
        const double square = r * r + z * z, distance = std::sqrt(square);
        if (distance < 1) {
            return {-vortex * z * r, speed - vortex + vortex * (2 * square - z * z), 10 * inner * vortex * z,
                    Phase::extracellular};
        }
        const double cube = distance * square;
        return {r * z * (stokeslet / cube + 3 * dipole / (cube * square)),
                stokeslet * (1 / distance + z * z / cube) + dipole * (3 * z * z / (cube * square) - 1 / cube),
                force * z / (4 * pi * cube), Phase::intracellular};
    }
};

struct Box {
    Parameters parameters;
    MembraneSpace space;
    BoxFlow box;
    MembraneState state;
    MembraneSamples samples;
    FlowSolution flow;
    FlowField field;

    Box(Index elements, double height)
        : space(elements, 8),
          box(parameters, space),
          state(bulge(space, height)),
          samples(sample(space, state)),
          field(make_field()) {}

    FlowField make_field() {
        const MobilityOperators operators = box.operators(state, samples);
        flow = box.solve(operators, samples,
                         energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first),
                         energy_density_at_rim(space, state, membrane_energy(parameters)));
        return {parameters,
                space,
                state,
                samples,
                {flow.velocity, flow.force},
                box.walls(),
                box.wall_unknowns(operators, flow)};
    }

    CurvePoint point(double xi) const { return curve_point(space.radial().basis(xi), space.axial().basis(xi), state); }
    double viscosity(Phase phase) const {
        return phase == Phase::extracellular ? parameters.fluid.viscosity_extracellular
                                             : parameters.fluid.viscosity_intracellular;
    }
};

double velocity_scale(const Box& box) {
    double largest = 0;
    for (const double xi : {0.1, 0.3, 0.5, 0.7}) {
        largest = std::max(
            largest, std::hypot(box.space.radial().basis(xi).evaluate(box.flow.velocity.head(box.space.radial_count())),
                                box.space.axial().basis(xi).evaluate(box.flow.velocity.tail(box.space.axial_count()))));
    }
    return largest;
}

}  // namespace

TEST_CASE("velocity and pressure in and around a rising drop are the exact ones up to its surface", "[fields]") {
    for (const double inner : {0.1, 1.0, 10.0}) {
        const Drop drop{inner, 1.0};
        const MembraneSpace space(32, 8);
        const auto state = state_of(
            space, [](double x) { return std::sin(pi * x); }, [](double x) { return std::cos(pi * x); },
            [](double) { return 0.0; });
        const MembraneSamples samples = sample(space, state);
        MembraneFlow flow{Eigen::VectorXd(space.curve_count()), Eigen::VectorXd(space.force_count())};
        const auto at = [&](double x) {
            return drop.at(0.999999999999 * std::sin(pi * x), 0.999999999999 * std::cos(pi * x));
        };
        flow.velocity << spline_of(space.radial(), [&](double x) { return at(x).u_r; }),
            spline_of(space.axial(), [&](double x) { return at(x).u_z; });
        flow.force << spline_of(space.radial(), [](double x) { return std::cos(pi * x) * std::sin(pi * x); }),
            spline_of(space.force(), [](double x) { return std::cos(pi * x) * std::cos(pi * x); });
        const MembraneSources sources(space, state, samples, flow, inner - 1.0);
        RingLayers layers;
        for (const double distance : {0.0, 0.5, 0.9, 0.99, 0.9999, 0.999999, 1.000001, 1.0001, 1.01, 1.1, 2.0}) {
            for (const double angle : {0.0, 0.01, 0.7, 1.6, 2.9}) {
                const Target target{distance * std::sin(angle), distance * std::cos(angle)};
                layers.start(target);
                sources.add_to(layers, target);
                const auto sum = layers.evaluate();
                const double scale = 8 * pi * (distance < 1 ? inner : 1.0);
                const FieldValue exact = drop.at(target.r, target.z);
                CAPTURE(inner, distance, angle);
                // The drop's speed itself has 1e-6 with 32 elements; p has derivatives of u in its density.
                CHECK(sum.momentum_r / scale == Approx(exact.u_r).margin(1e-6 * drop.speed));
                CHECK(sum.momentum_z / scale == Approx(exact.u_z).margin(1e-6 * drop.speed));
                CHECK(sum.pressure == Approx(exact.pressure).margin(1e-5));
            }
        }
    }
}

TEST_CASE("in the box the velocity is continuous through the membrane and the pressure jumps by its force",
          "[fields]") {
    const Box box(48, 30);
    const double scale = velocity_scale(box);
    for (const double xi : {0.0, 0.013, 0.25, 0.4375, 0.6, 0.8}) {
        const CurvePoint p = box.point(xi);
        const double u_r = box.space.radial().basis(xi).evaluate(box.flow.velocity.head(box.space.radial_count()));
        const double u_z = box.space.axial().basis(xi).evaluate(box.flow.velocity.tail(box.space.axial_count()));
        const double offset = 1e-4;  // nm; u changes over some 10 nm
        const auto side = [&](double sign) {
            return box.field.at({p.r + sign * offset * p.normal_r, p.z + sign * offset * p.normal_z}, 1e-6);
        };
        const FieldValue below = side(-1), above = side(1);
        CAPTURE(xi);
        CHECK(below.phase == Phase::extracellular);
        CHECK(above.phase == Phase::intracellular);
        for (const FieldValue& value : {below, above}) {
            CHECK(value.u_r == Approx(u_r).margin(1e-5 * scale));
            CHECK(value.u_z == Approx(u_z).margin(1e-5 * scale));
        }
        const double f_n =
            p.normal_r * box.space.radial().basis(xi).evaluate(box.flow.force.head(box.space.radial_count())) +
            p.normal_z * box.space.force().basis(xi).evaluate(box.flow.force.tail(box.space.force().dimension()));
        // (A.17) with div_Gamma u = 0
        CHECK(above.pressure - below.pressure == Approx(f_n).epsilon(1e-4).margin(1e-5));
    }
}

TEST_CASE("the fields in the box solve the Stokes equations", "[fields]") {
    const Box box(48, 30);
    const double scale = velocity_scale(box);
    const double h = 0.5;  // nm; central differences of fields that vary over 10 nm: (h/10)^2
    for (const Target x : {Target{5, 60}, Target{20, 95}, Target{40, 30}, Target{50, 120}, Target{12, 125},
                           Target{70, 84}, Target{30, 104}}) {
        const auto at = [&](double dr, double dz) { return box.field.at({x.r + dr, x.z + dz}, 1e-3); };
        const FieldValue c = at(0, 0), e = at(h, 0), w = at(-h, 0), n = at(0, h), s = at(0, -h);
        const double nu = box.viscosity(c.phase);
        const double divergence = (e.u_r - w.u_r) / (2 * h) + c.u_r / x.r + (n.u_z - s.u_z) / (2 * h);
        const auto laplacian = [&](double centre, double east, double west, double north, double south) {
            return (east + west + north + south - 4 * centre) / (h * h) + (east - west) / (2 * h * x.r);
        };
        const double momentum_r = nu * (laplacian(c.u_r, e.u_r, w.u_r, n.u_r, s.u_r) - c.u_r / (x.r * x.r)) -
                                  (e.pressure - w.pressure) / (2 * h);
        const double momentum_z =
            nu * laplacian(c.u_z, e.u_z, w.u_z, n.u_z, s.u_z) - (n.pressure - s.pressure) / (2 * h);
        const double gradient = std::hypot(e.pressure - w.pressure, n.pressure - s.pressure) / (2 * h);
        CAPTURE(x.r, x.z, c.u_r, c.u_z, c.pressure, gradient);
        CHECK(std::abs(divergence) < 2e-4 * scale / 10);
        CHECK(std::abs(momentum_r) < 2e-3 * (gradient + nu * scale / 1000));
        CHECK(std::abs(momentum_z) < 2e-3 * (gradient + nu * scale / 1000));
    }
}

TEST_CASE("at the free walls the pressure balances the viscous stress", "[fields]") {
    const Box box(48, 30);
    const double h = 0.01;
    for (const double r : {3.0, 30.0, 60.0}) {
        const double top = box.parameters.domain.height;
        const auto at = [&](double depth) { return box.field.at({r, top - depth}, 1e-4); };
        const FieldValue near = at(h), mid = at(2 * h), far = at(3 * h);
        const double nu = box.viscosity(Phase::intracellular);
        const double normal_stress = -mid.pressure + 2 * nu * (near.u_z - far.u_z) / (2 * h);
        const double scale = std::abs(mid.pressure) + nu * std::abs(mid.u_z) / 80;
        CAPTURE(r, mid.pressure, mid.u_z);
        CHECK(std::abs(normal_stress) < 1e-4 * scale);
    }
}

TEST_CASE("without forces nothing moves and the pressure is zero", "[fields]") {
    const Parameters parameters;
    const MembraneSpace space(16, 8);
    const BoxFlow box(parameters, space);
    const MembraneState state = state_of(
        space, [](double x) { return 80 * x; }, [](double) { return 80.0; }, [](double) { return 0.0; });
    const MembraneSamples samples = sample(space, state);
    const FlowField field(parameters, space, state, samples,
                          {Eigen::VectorXd::Zero(space.curve_count()), Eigen::VectorXd::Zero(space.force_count())},
                          box.walls(), Eigen::VectorXd::Zero(box.walls().unknowns()));
    // Corners, walls, axis, rim and membrane are moved inwards: everything stays finite.
    for (const Target target : {Target{0, 0}, Target{80, 0}, Target{80, 80}, Target{0, 80}, Target{40, 80},
                                Target{80, 160}, Target{0, 160}, Target{20, 30}}) {
        const FieldValue value = field.at(target, 2e-3);
        CHECK(value.u_r == 0);
        CHECK(value.u_z == 0);
        CHECK(value.pressure == 0);
        CHECK((value.phase == Phase::intracellular) == (target.z > 80));
    }
}
