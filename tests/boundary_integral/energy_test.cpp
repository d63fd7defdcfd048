// The discrete energy: its value on a sphere, and its gradient and Hessian against finite differences.

#include <catch2/catch.hpp>
#include <numbers>
#include <random>
#include <type_traits>

#include "boundary_integral/membrane/energy.h"
#include "curves.h"
#include "shared/model/bending_term.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

Eigen::VectorXd curve_vector(const MembraneState& state) {
    Eigen::VectorXd x(state.r.size() + state.z.size());
    x << state.r, state.z;
    return x;
}

MembraneState displaced(const MembraneState& state, const Eigen::VectorXd& direction, double amount) {
    MembraneState moved = state;
    moved.r += amount * direction.head(state.r.size());
    moved.z += amount * direction.tail(state.z.size());
    return moved;
}

Eigen::VectorXd random_vector(Index size, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd vector(size);
    for (double& value : vector) value = uniform(engine);
    return vector;
}

// Fourth-order central difference of f(amount) at 0.
template <class Function>
std::invoke_result_t<Function, double> central_difference(Function f, double step) {
    return ((8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step));
}

double energy_of(const MembraneSpace& space, const MembraneState& state, const MembraneEnergy& energy) {
    return energy_derivatives(space, state, energy, Derivatives::first).energy;
}

// A term no engine knows of: whatever is written like this one is differentiated by the engine.
struct ToyTerm {
    template <class Number>
    Number density(const LocalShape<Number>& x) const {
        const Number squared = x.curvature * x.curvature;
        return 300.0 * (1.0 + x.concentration) * squared * squared + 20.0 * x.squared_gradient * (1.0 + squared);
    }
};

}  // namespace

TEST_CASE("the energy of a hemisphere is that of its curvature 2/a", "[energy]") {
    const double radius = 20;
    const MembraneSpace space(40, 8);
    const auto state = state_of(
        space, [&](double x) { return radius * std::sin(0.5 * std::numbers::pi * x); },
        [&](double x) { return radius * std::cos(0.5 * std::numbers::pi * x); }, [](double) { return 1.0; });
    MembraneParameters membrane;
    const BendingModel model(membrane);
    const double excess = 2 / radius - model.spontaneous_curvature(1).value;
    const double expected = 0.5 * model.stiffness(1).value * excess * excess * radius * radius;  // per 2 pi
    CHECK(energy_of(space, state, MembraneEnergy().add(BendingTerm{model})) ==
          Approx(expected).epsilon(1e-8));  // h^6 of the interpolated curve
    CHECK(sample(space, state).curve.front().total_curvature() == Approx(2 / radius).epsilon(1e-6));
}

TEST_CASE("the force is minus the variation of the energy", "[energy]") {
    const auto law = GENERATE(ConstitutiveLaw::linear, ConstitutiveLaw::coarse_grained, ConstitutiveLaw::lumped);
    const MembraneSpace space(24, 8);
    const MembraneState state = bulge(space, 25);
    MembraneParameters membrane;
    membrane.constitutive_law = law;
    MembraneEnergy energy = MembraneEnergy().add(BendingTerm{BendingModel(membrane)});
    if (GENERATE(false, true)) energy.add(ToyTerm{});
    const EnergyDerivatives exact = energy_derivatives(space, state, energy, Derivatives::second);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Eigen::VectorXd direction = random_vector(space.curve_count(), seed);
        constexpr double step = 1e-4;  // truncation ~ step^4, round-off ~ 1e-16 E / step
        const double difference = central_difference(
            [&](double h) { return energy_of(space, displaced(state, direction, h), energy); }, step);
        CHECK(exact.gradient.dot(direction) == Approx(difference).epsilon(1e-7));
        const Eigen::VectorXd gradient_difference = central_difference(
            [&](double h) -> Eigen::VectorXd {
                return energy_derivatives(space, displaced(state, direction, h), energy, Derivatives::first).gradient;
            },
            step);
        CHECK((exact.hessian * direction - gradient_difference).norm() < 1e-7 * gradient_difference.norm());

        const Eigen::VectorXd c_direction = random_vector(space.axial_count(), seed + 10);
        const auto with_c = [&](double h) {
            MembraneState changed = state;
            changed.c += h * c_direction;
            return energy_derivatives(space, changed, energy, Derivatives::first);
        };
        const double c_difference = central_difference([&](double h) { return with_c(h).energy; }, step);
        CHECK(exact.gradient_c.dot(c_direction) == Approx(c_difference).epsilon(1e-7));
        const Eigen::VectorXd mixed_difference =
            central_difference([&](double h) -> Eigen::VectorXd { return with_c(h).gradient; }, step);
        CHECK((exact.mixed * c_direction - mixed_difference).norm() < 1e-7 * mixed_difference.norm());
        const Eigen::VectorXd second_difference =
            central_difference([&](double h) -> Eigen::VectorXd { return with_c(h).gradient_c; }, step);
        CHECK((exact.second_c * c_direction - second_difference).norm() < 1e-7 * second_difference.norm());
    }
}

TEST_CASE("the divergence matrix is the variation of area, and its variation the second", "[energy]") {
    const MembraneSpace space(24, 8);
    const MembraneState state = bulge(space, 25);
    const Eigen::VectorXd tension = random_vector(space.tension().dimension(), 5);
    const Eigen::VectorXd direction = random_vector(space.curve_count(), 6);
    const Eigen::VectorXd velocity = random_vector(space.curve_count(), 7);
    const auto values = values_at_points(space.tension_rows, tension);
    const auto weighted_area = [&](const MembraneState& at) {
        const MembraneSamples samples = sample(space, at);
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum += space.weight[i] * values[i] * samples.curve[i].r * samples.curve[i].g;
        }
        return sum;
    };
    constexpr double step = 1e-4;
    const Eigen::MatrixXd divergence = divergence_matrix(space, sample(space, state));
    const double difference =
        (weighted_area(displaced(state, direction, step)) - weighted_area(displaced(state, direction, -step))) /
        (2 * step);
    CHECK(tension.dot(divergence * direction) == Approx(difference).epsilon(1e-7));

    const Eigen::VectorXd change =
        (divergence_matrix(space, sample(space, displaced(state, direction, step))) * velocity -
         divergence_matrix(space, sample(space, displaced(state, direction, -step))) * velocity) /
        (2 * step);
    const Eigen::VectorXd exact = divergence_variation(space, sample(space, state), velocity) * direction;
    CHECK((exact - change).norm() < 1e-6 * change.norm());
}

TEST_CASE("the force density of a smooth shape is (A.25)", "[energy]") {
    // On a sphere with uniform c every term but two of (A.25) vanishes: with kappa = 2/a, ||grad n||^2 = 2/a^2,
    //     F.n = beta (kappa - C) (2/a^2 - (kappa - C) kappa / 2).
    const double radius = 20;
    const MembraneSpace space(40, 8);
    const auto state = state_of(
        space, [&](double x) { return radius * std::sin(0.5 * std::numbers::pi * x); },
        [&](double x) { return radius * std::cos(0.5 * std::numbers::pi * x); }, [](double) { return 0.5; });
    const BendingModel model(MembraneParameters{});
    const EnergyDerivatives energy =
        energy_derivatives(space, state, MembraneEnergy().add(BendingTerm{model}), Derivatives::first);
    const double beta = model.stiffness(0.5).value, excess = 2 / radius - model.spontaneous_curvature(0.5).value;
    const double normal_force = beta * excess * (2 / (radius * radius) - 0.5 * excess * 2 / radius);
    // Test with a smooth velocity that vanishes with its derivatives at the end of the curve: w = (1 - x^2)^4 n.
    const auto bump = [](double x) { return std::pow(1 - x * x, 4); };
    const Eigen::VectorXd w_r =
        spline_of(space.radial(), [&](double x) { return bump(x) * std::sin(0.5 * std::numbers::pi * x); });
    const Eigen::VectorXd w_z =
        spline_of(space.axial(), [&](double x) { return bump(x) * std::cos(0.5 * std::numbers::pi * x); });
    Eigen::VectorXd w(space.curve_count());
    w << w_r, w_z;
    const MembraneSamples samples = sample(space, state);
    double work = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        work += space.weight[i] * samples.curve[i].r * samples.curve[i].g * normal_force * bump(space.xi[i]);
    }
    CHECK(-energy.gradient.dot(w) == Approx(work).epsilon(1e-6));
    CHECK(curve_vector(state).size() == space.curve_count());
}
