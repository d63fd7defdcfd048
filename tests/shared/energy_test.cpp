// The membrane's energy as a sum of terms: derivatives, and the form in which the moment takes the curvature's place.

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/model/bending_term.h"
#include "shared/model/initial_condition.h"
#include "shared/model/loads.h"
#include "shared/model/membrane_energy.h"
#include "shared/support/error.h"

using namespace endoflow;

namespace {

/// Stiffer at high curvatures and where c changes: convex, and quadratic in nothing.
struct StiffeningTerm {
    double strength;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        const Number squared = x.curvature * x.curvature;
        return strength * ((1.0 + x.concentration) * squared * squared + x.squared_gradient * (1.0 + squared));
    }
};

struct LinearTerm {
    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        return 3.0 * x.concentration * x.curvature;
    }
};

using Point = std::array<double, local::count>;

/// Derivatives against central differences of the given step: the error is step² of truncation and 1e-16/step.
template <class Function>
void check_jet(const Function& f, const Point& at) {
    constexpr double step = 1e-5;
    const LocalJet here = f(at);
    double scale = 0, second_scale = 0;
    for (std::size_t i = 0; i < local::count; ++i) {
        scale = std::max(scale, std::abs(here.partial[i]));
        for (std::size_t j = 0; j < local::count; ++j)
            second_scale = std::max(second_scale, std::abs(here.second[i][j]));
    }
    for (std::size_t i = 0; i < local::count; ++i) {
        Point above = at, below = at;
        above[i] += step, below[i] -= step;
        const LocalJet up = f(above), down = f(below);
        CHECK(here.partial[i] == Approx((up.value - down.value) / (2 * step)).margin(1e-8 * scale));
        for (std::size_t j = 0; j < local::count; ++j) {
            CAPTURE(i, j);
            CHECK(here.second[i][j] ==
                  Approx((up.partial[j] - down.partial[j]) / (2 * step)).margin(1e-8 * second_scale));
        }
    }
}

MembraneEnergy stiffening_membrane() {
    return membrane_energy(Parameters{}).add(StiffeningTerm{40});
}

}  // namespace

TEST_CASE("an energy's derivatives agree with finite differences, those of its Legendre transform, too") {
    for (const auto law : {ConstitutiveLaw::linear, ConstitutiveLaw::coarse_grained, ConstitutiveLaw::lumped}) {
        Parameters parameters;
        parameters.membrane.constitutive_law = law;
        Parameters coupled = parameters;
        coupled.molecules.coupling = Coupling::energetic;
        coupled.molecules.line_energy = 20;
        for (const MembraneEnergy& energy :
             {membrane_energy(parameters), membrane_energy(coupled), stiffening_membrane()}) {
            check_jet([&](const Point& x) { return energy.density(x[0], x[1], x[2]); }, {0.11, 0.4, 0.02});
            check_jet([&](const Point& x) { return energy.conjugate(x[0], x[1], x[2]); }, {7.0, 0.4, 0.02});
        }
    }
}

TEST_CASE("the curvature of a moment is that at which the energy has this moment") {
    const MembraneEnergy energy = stiffening_membrane();
    for (const double moment : {-30.0, 0.0, 2.0, 400.0}) {
        const auto state = elastic_state<double>(energy, moment, 0.7, 0.1);
        const LocalJet e = energy.density(state.curvature, 0.7, 0.1);
        CHECK(e.partial[local::curvature] == Approx(moment).margin(1e-10));
        CHECK(state.density == Approx(e.value).epsilon(1e-12));
        CHECK(state.by_concentration == Approx(e.partial[local::concentration]).epsilon(1e-12));
        // Wherever the search starts it ends there, by quadratic convergence to round-off.
        for (const double near : {-0.4, 0.9 * state.curvature, 2.0})
            CHECK(energy.conjugate(moment, 0.7, 0.1, near).partial[local::moment] ==
                  Approx(state.curvature).epsilon(1e-12).margin(1e-12));
        CHECK(state.by_squared_gradient == Approx(e.partial[local::squared_gradient]).epsilon(1e-12));
    }
}

TEST_CASE("bending: κ = C + m/β and e = m²/(2β)") {
    const Parameters parameters;
    const BendingModel model(parameters.membrane);
    for (const double c : {0.0, 0.3, 1.0}) {
        const double moment = 5, beta = model.stiffness(c).value, spontaneous = model.spontaneous_curvature(c).value;
        const auto state = elastic_state<double>(membrane_energy(parameters), moment, c, 0);
        CHECK(state.curvature == Approx(spontaneous + moment / beta).epsilon(1e-14));
        CHECK(state.density == Approx(0.5 * moment * moment / beta).epsilon(1e-13));
        CHECK(state.by_squared_gradient == 0);
    }
}

TEST_CASE("an energy whose moment does not determine the curvature is an error with a name") {
    const MembraneEnergy energy = MembraneEnergy().add(LinearTerm{});
    CHECK_THROWS_AS(energy.conjugate(1, 0.5, 0), SolverError);
    CHECK(std::isnan(energy.conjugate(std::nan(""), 0.5, 0).value));
}

TEST_CASE("a flat edge costs σ̂ √2/6 per length") {
    Parameters parameters;
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 20;
    const double width = parameters.molecules.interface_width, middle = parameters.molecules.patch_radius;
    const MembraneEnergy edge = line_energy(parameters);
    double cost = 0;
    constexpr double step = 0.01;  // the trapezoidal rule is exact to round-off for a function that decays at both ends
    for (int i = -3000; i <= 3000; ++i) {
        const double x = middle + step * i;
        const double c = initial_concentration(parameters.molecules, x);
        const double slope = std::sqrt(2.0) * c * (1 - c) / width;
        cost += step * edge.density(0.1, c, slope * slope).value;
    }
    CHECK(cost == Approx(20 * std::sqrt(2.0) / 6).epsilon(1e-12));
    CHECK(line_energy(Parameters{}).density(0.1, 0.5, 0.3).value == 0);  // without coupling
}

TEST_CASE("an engine without energetic coupling refuses it") {
    Parameters parameters;
    CHECK_NOTHROW(require_no_loads(parameters, "phase-field"));
    parameters.molecules.coupling = Coupling::energetic;
    parameters.molecules.line_energy = 20;
    CHECK_THROWS_AS(require_no_loads(parameters, "phase-field"), InputError);
}
