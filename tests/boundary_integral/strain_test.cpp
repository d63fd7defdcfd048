// The stretching of the material: prescribed rates, then an extensible membrane whose area says what it must be.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "boundary_integral/evolution/material_strain.h"
#include "boundary_integral/integration/stiff_integrator.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;

// int r g dxi from the axis to xi.
double area_within(const MembraneSpace& space, const MembraneState& state, double xi) {
    const QuadratureRule rule = gauss_legendre(8);
    double area = 0;
    for (double begin = 0; begin < xi; begin += space.element_width()) {
        const double end = std::min(begin + space.element_width(), xi);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double at = begin + 0.5 * (end - begin) * (1 + rule.nodes[q]);
            const CurvePoint p = curve_point(space.radial().basis(at), space.axial().basis(at), state);
            area += 0.5 * (end - begin) * rule.weights[q] * p.r * p.g;
        }
    }
    return area;
}

}  // namespace

TEST_CASE("markers go with the material and add up its growth", "[strain]") {
    const MembraneSpace space(16, 8);
    MaterialStrain strain(space);
    CHECK(strain.largest() == 0);
    const std::size_t count = 8 * 16 + 1;
    MaterialRates before{std::vector<double>(count), std::vector<double>(count)}, after = before;
    for (std::size_t i = 0; i < count; ++i) {
        const double xi = static_cast<double>(i) / static_cast<double>(count - 1);
        before.drift[i] = after.drift[i] = -xi;  // xi(t) = xi(0) exp(-t)
        before.growth[i] = 0.0;
        after.growth[i] = 0.2 * xi;
    }
    const std::size_t followed = 40;
    const double start = strain.markers().xi[followed];
    for (int step = 0; step < 10; ++step) {
        // growth 0.2 xi t along the whole second
        MaterialRates one = before, two = before;
        for (std::size_t i = 0; i < count; ++i) {
            one.growth[i] = after.growth[i] * step / 10.0;
            two.growth[i] = after.growth[i] * (step + 1) / 10.0;
        }
        strain.advance(one, two, 0.1);
    }
    const double e = std::exp(-1.0);
    CHECK(strain.markers().xi[followed] == Approx(start * e).epsilon(1e-3));
    CHECK(strain.markers().log_growth[followed] == Approx(0.2 * start * (1 - 2 * e)).epsilon(1e-3));
    CHECK(strain.markers().xi.back() > 1 - 1 / 64.0);  // the rim has been refilled
    CHECK(strain.markers().log_growth.back() < 0.01);
    CHECK(std::is_sorted(strain.markers().xi.begin(), strain.markers().xi.end()));

    for (double& value : before.drift) value = 10;  // everything leaves
    strain.advance(before, before, 1.0);
    CHECK(strain.markers().xi.size() == 1);
    CHECK(strain.largest() == 0);
}

TEST_CASE("a sphere that swells grows by twice its rate, at both poles, too", "[strain]") {
    const MembraneSpace space(16, 8, CurveEnd::closed);
    Evaluation e{};
    e.state.r = testing::spline_of(space.radial(), [](double xi) { return 40 * std::sin(M_PI * xi); });
    e.state.z = testing::spline_of(space.axial(), [](double xi) { return 40 * std::cos(M_PI * xi); });
    e.flow.velocity.resize(space.curve_count());
    e.flow.velocity << e.state.r, e.state.z;  // a velocity of x/µs
    e.mesh_velocity = Eigen::VectorXd::Zero(space.curve_count());
    // exact for any spline: the velocity is the position
    for (const double growth : MaterialStrain(space).rates(e).growth) CHECK(growth == Approx(2).epsilon(1e-9));
}

TEST_CASE("the stretching of an extensible membrane is that of its area", "[strain]") {
    Parameters parameters;
    parameters.membrane.inextensible = false;
    parameters.boundary_integral.elements = 24;
    MembraneDynamics dynamics(parameters);
    const MembraneSpace& space = dynamics.space();
    MaterialStrain strain(space);
    const Eigen::VectorXd y = dynamics.initial_vector();
    const MembraneState initial = dynamics.unpack(y);
    const auto start = strain.markers().xi;
    StiffProblem problem;
    Evaluation now = dynamics.evaluate(0, y);
    problem.begin_step = [](const Eigen::VectorXd&) {};
    problem.rate = [&](double /*time*/, const Eigen::VectorXd& at) {
        now = dynamics.evaluate(0, at);
        return now.rate;
    };
    problem.jacobian = [&] { return dynamics.jacobian(now); };
    problem.error_scales = dynamics.error_scales(y, 1e-6, 1e-6);
    StiffIntegrator integrator(problem, {0, 1e-7, y}, {1e-4, 1e-14});
    MaterialRates rates = strain.rates(now);
    for (double time = 0; time < 0.002; time = integrator.time()) {
        integrator.advance(0.002);
        now = dynamics.evaluate(0, integrator.state());
        const MaterialRates next = strain.rates(now);
        strain.advance(rates, next, integrator.time() - time);
        rates = next;
    }
    const auto& markers = strain.markers();
    CHECK(strain.largest() > 0.05);
    for (const std::size_t i : {4u, 20u, 36u, 52u, 68u}) {
        // area(t) = int exp(log growth) dA(0), by Simpson's rule on the markers' initial cells
        double expected = 0;
        for (std::size_t k = 0; k < i; k += 2) {
            const auto value = [&](std::size_t m) {
                const CurvePoint p =
                    curve_point(space.radial().basis(start[m]), space.axial().basis(start[m]), initial);
                return p.r * p.g * std::expm1(markers.log_growth[m]);
            };
            expected += (start[k + 2] - start[k]) / 6 * (value(k) + 4 * value(k + 1) + value(k + 2));
        }
        const double before = area_within(space, initial, start[i]);
        const double after = area_within(space, now.state, markers.xi[i]);
        CAPTURE(i, start[i], markers.xi[i], before, after - before, expected);
        CHECK(after - before == Approx(expected).epsilon(1e-3));
    }
}
