// Closed vesicles against the published phase diagram, exact identities and the perturbed sphere.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "default_rule.h"
#include "shared/support/error.h"
#include "statics/vesicle_state.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

using std::numbers::pi;
constexpr double radius = 20, stiffness = 50;  // of the sphere with the same area, nm; pN nm

/// ½ β (κ − C)²
struct Bending {
    double stiffness, spontaneous_curvature;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        const Number excess = x.curvature - spontaneous_curvature;
        return 0.5 * stiffness * excess * excess;
    }
};

ClosedMembrane membrane(const MembraneEnergy& energy, double reduced_volume) {
    return with_reduced_volume({energy, 1, 4 * pi * radius * radius, 0}, reduced_volume);
}

ClosedMembrane membrane(double reduced_volume, double reduced_curvature = 0) {
    return membrane(MembraneEnergy().add(Bending{stiffness, reduced_curvature / radius}), reduced_volume);
}

/// In units of a sphere's energy at C = 0.
double reduced_energy(const VesicleState& state) {
    return state.bending_energy() / (8 * pi * stiffness);
}

double reduced_energy(double reduced_volume, VesicleFamily family) {
    return reduced_energy(find_vesicle(membrane(reduced_volume), family));
}

double distance_of_poles(const VesicleState& state) {
    return -state.solution.nodes(state::height, state.solution.nodes.cols() - 1);
}

}  // namespace

TEST_CASE("Vesicles without spontaneous curvature: the published phase diagram", "[vesicles]") {
    // Seifert, Berndl & Lipowsky (1991): the shape of least energy is prolate for v >= 0.652, oblate for
    // 0.592 <= v <= 0.651, a stomatocyte for v <= 0.591.
    CHECK(reduced_energy(0.652, VesicleFamily::prolate) < reduced_energy(0.652, VesicleFamily::oblate));
    CHECK(reduced_energy(0.651, VesicleFamily::prolate) > reduced_energy(0.651, VesicleFamily::oblate));
    CHECK(reduced_energy(0.592, VesicleFamily::oblate) < reduced_energy(0.592, VesicleFamily::stomatocyte));
    CHECK(reduced_energy(0.591, VesicleFamily::oblate) > reduced_energy(0.591, VesicleFamily::stomatocyte));
}

TEST_CASE("Stomatocytes end in a fold", "[vesicles]") {
    // Published to two digits: v = 0.66.
    const auto state = find_vesicle(membrane(0.6), VesicleFamily::stomatocyte);
    const auto path = [](double v) { return membrane(v); };
    const auto branch = continue_vesicle(state, path, 0.6, 0.8, [](const BranchPoint&) { return true; });
    REQUIRE(branch);
    REQUIRE(branch->folds.size() == 1);
    CHECK(branch->folds.front().parameter() == Approx(0.66).margin(0.005));
}

TEST_CASE("A vesicle near the sphere is the perturbed sphere R (1 + a P2)", "[vesicles]") {
    // To second order v = 1 - 3 a²/5 and E = 8πβ (1 + 2 (1 - v)), the soft mode's pressure being p = -12 β/R³; the next
    // terms are odd in a for E and p, so the mean of both families has an error of order a² relative to the effect.
    const auto remainders = [](double v) {
        const auto prolate = find_vesicle(membrane(v), VesicleFamily::prolate);
        const auto oblate = find_vesicle(membrane(v), VesicleFamily::oblate);
        const double a = std::sqrt(5 * (1 - v) / 3), cubed = radius * radius * radius;
        return Eigen::Vector3d((0.5 * (reduced_energy(prolate) + reduced_energy(oblate)) - 1) / (2 * (1 - v)) - 1,
                               0.5 * (prolate.pressure() + oblate.pressure()) * cubed / (-12 * stiffness) - 1,
                               (distance_of_poles(prolate) - distance_of_poles(oblate)) / (4 * radius * a) - 1);
    };
    const Eigen::Vector3d far = remainders(0.996), near = remainders(0.999);  // a is halved
    for (Eigen::Index i = 0; i < 3; ++i) {
        CAPTURE(i, far(i), near(i));
        CHECK(std::abs(near(i)) < 2e-3);
        CHECK(far(i) / near(i) == Approx(4).epsilon(0.05));
    }
}

TEST_CASE("Stationary vesicles satisfy the identities of the variational problem", "[vesicles]") {
    const auto [family, v] = GENERATE(std::pair(VesicleFamily::prolate, 0.8), std::pair(VesicleFamily::oblate, 0.6),
                                      std::pair(VesicleFamily::stomatocyte, 0.6));
    const double curvature = GENERATE(0.0, -0.4);
    const auto state = find_vesicle(membrane(v, curvature), family);
    const auto& nodes = state.solution.nodes;
    const Eigen::Index last = nodes.cols() - 1;
    CAPTURE(v, curvature);
    CHECK(state.relative_error < 1e-7);  // the stomatocyte with C < 0, whose neck is narrow; 1e-12 for the others
    CHECK(nodes(state::cosine, last) == Approx(-1).epsilon(1e-9));

    SECTION("the tension is the same everywhere") {
        for (const Eigen::Index i : {last / 4, last / 2, last - 1})
            CHECK(point_of_vesicle(state.membrane, state.pressure(), 0, nodes.col(i)).tension ==
                  Approx(state.tension()).epsilon(1e-8).margin(1e-9 * stiffness / (radius * radius)));
    }
    SECTION("dE/dV = p at fixed area") {
        const double step = 1e-3;
        const double slope = (find_vesicle(membrane(v + step, curvature), family).bending_energy() -
                              find_vesicle(membrane(v - step, curvature), family).bending_energy()) /
                             (2 * step * 4 * pi / 3 * std::pow(radius, 3));
        CHECK(slope == Approx(state.pressure()).epsilon(1e-4));  // central difference: step² E'''/(6 E')
    }
    SECTION("dilation") {
        // E(C/s, s² A, s³ V) does not depend on s, dE/dA = -λ, dE/dV = p and dE/dC = -∫ β (κ - C) dA, so
        // 2 λ A - 3 p V - C ∫ β (κ - C) dA = 0.
        double moments = 0;
        for (std::size_t i = 0; i < state.solution.elements(); ++i)
            for (int j = 0; j < default_rule.points; ++j) {
                const double x = state.solution.mesh[i] + state.solution.width(i) * default_rule.nodes(j);
                moments += state.membrane.area * state.solution.width(i) * default_rule.weights(j) *
                           evaluate(state.solution, default_rule, x)(state::moment);
            }
        const double stretching = 2 * state.tension() * state.membrane.area;
        const double inflation = 3 * state.pressure() * state.membrane.volume;
        const double bending = state.membrane.spontaneous_curvature * moments;
        CHECK(std::abs(stretching - inflation - bending) < 1e-8 * std::max(std::abs(stretching), stiffness));
    }
}

TEST_CASE("Vesicles follow an energy that statics does not know", "[vesicles]") {
    // ½ β (κ − C)² + ½ γ κ² = ½ (β + γ) (κ − C β/(β + γ))² + a constant.
    const double more = 20, curvature = -0.4 / radius;
    MembraneEnergy energy;
    energy.add(Bending{stiffness, curvature}).add(Bending{more, 0});
    const double sum = stiffness + more, shared = curvature * stiffness / sum;
    const auto state = find_vesicle(membrane(energy, 0.8), VesicleFamily::prolate);
    const auto same = find_vesicle(membrane(MembraneEnergy().add(Bending{sum, shared}), 0.8), VesicleFamily::prolate);
    CHECK(state.pressure() == Approx(same.pressure()).epsilon(1e-10));
    const double constant = 0.5 * (stiffness * curvature * curvature - sum * shared * shared);  // pN/nm
    CHECK(state.bending_energy() - same.bending_energy() == Approx(constant * state.membrane.area).epsilon(1e-8));
    CHECK(same.tension() - state.tension() == Approx(constant).epsilon(1e-8));
}

TEST_CASE("Vesicles converge with the order of the collocation", "[vesicles]") {
    const double exact = find_vesicle(membrane(0.7), VesicleFamily::prolate).bending_energy();
    const auto error = [&](std::size_t elements) {
        // find_vesicle() cuts every element in two at the end: its error is that of twice as many.
        return std::abs(find_vesicle(membrane(0.7), VesicleFamily::prolate, {2, elements}).bending_energy() / exact -
                        1);
    };
    const double coarse = error(16), fine = error(32);
    CAPTURE(coarse, fine);
    CHECK(fine < 1e-6);
    CHECK(std::log2(coarse / fine) > 3.5);  // two Gauss points: 4
}

TEST_CASE("Vesicles that cannot be are refused", "[vesicles]") {
    CHECK_THROWS_AS(find_vesicle(membrane(1.01), VesicleFamily::prolate), InputError);
    CHECK_THROWS_AS(find_vesicle(membrane(0.7), VesicleFamily::stomatocyte), SolverError);  // beyond the fold
}
