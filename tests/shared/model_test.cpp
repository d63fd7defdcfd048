#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "shared/model/bending_model.h"
#include "shared/model/double_well.h"
#include "shared/model/initial_condition.h"

using namespace endoflow;

namespace {

// Central differences of O(h²): with h = 1e-5 of a function of order one the error is 1e-10 truncation and
// 1e-16/1e-5 round-off, so 1e-8 relative is safe for first derivatives, and for second ones taken of the first.
constexpr double h = 1e-5;
constexpr double tolerance = 1e-8;

template <class Function>
void check_derivatives(const Function& f, double at) {
    const auto here = f(at), above = f(at + h), below = f(at - h);
    const double scale = std::abs(here.value) + std::abs(here.first) + std::abs(here.second);
    CHECK(here.first == Approx((above.value - below.value) / (2 * h)).margin(tolerance * scale));
    CHECK(here.second == Approx((above.first - below.first) / (2 * h)).margin(tolerance * scale));
}

MembraneParameters membrane(ConstitutiveLaw law, CurvatureConvention convention) {
    MembraneParameters m;
    m.constitutive_law = law;
    m.curvature_convention = convention;
    return m;
}

constexpr auto laws = {ConstitutiveLaw::linear, ConstitutiveLaw::coarse_grained, ConstitutiveLaw::lumped};
constexpr auto conventions = {CurvatureConvention::as_printed, CurvatureConvention::consistent};

}  // namespace

TEST_CASE("derivatives of the constitutive laws agree with finite differences") {
    for (const auto law : laws)
        for (const auto convention : conventions) {
            const BendingModel model(membrane(law, convention));
            for (const double c : {-0.01, 0.1, 0.5, 0.9, 1.0}) {
                check_derivatives([&](double x) { return model.stiffness(x); }, c);
                check_derivatives([&](double x) { return model.spontaneous_curvature(x); }, c);
            }
        }
}

TEST_CASE("every law gives the bare membrane at c = 0 and the coated stiffness at c = 1") {
    for (const auto law : laws) {
        const BendingModel model(membrane(law, CurvatureConvention::consistent));
        CHECK(model.stiffness(0).value == Approx(100).epsilon(1e-14));
        CHECK(model.stiffness(1).value == Approx(1200).epsilon(1e-14));
        CHECK(model.spontaneous_curvature(0).value == 0);
    }
    const BendingModel linear(membrane(ConstitutiveLaw::linear, CurvatureConvention::consistent));
    CHECK(linear.spontaneous_curvature(1).value == Approx(1 / 14.1).epsilon(1e-8));
    // (A.7) and (A.8): the bare membrane under a molecule resists it, H0 b_c/(b_c + b_m) with b_c = 11 b_m.
    for (const auto law : {ConstitutiveLaw::coarse_grained, ConstitutiveLaw::lumped}) {
        const BendingModel model(membrane(law, CurvatureConvention::consistent));
        CHECK(model.spontaneous_curvature(1).value == Approx(11.0 / 12 / 14.1).epsilon(1e-8));
    }
}

TEST_CASE("the conventions differ by half the stiffness and twice the curvature") {
    for (const auto law : laws) {
        const BendingModel printed(membrane(law, CurvatureConvention::as_printed));
        const BendingModel consistent(membrane(law, CurvatureConvention::consistent));
        for (const double c : {0.0, 0.3, 1.0}) {
            CHECK(printed.stiffness(c).value == 0.5 * consistent.stiffness(c).value);
            CHECK(printed.spontaneous_curvature(c).value == 2 * consistent.spontaneous_curvature(c).value);
        }
    }
}

TEST_CASE("the double well is (24)'s: W' = 4c³ − 6c² + 2c, minima at 0 and 1") {
    for (const double c : {-0.2, 0.0, 0.3, 0.5, 1.0, 1.1}) {
        CHECK(double_well(c).first == Approx(4 * c * c * c - 6 * c * c + 2 * c).margin(1e-14));
        check_derivatives([](double x) { return double_well(x); }, c);
    }
    CHECK(double_well(0).value == 0);
    CHECK(double_well(1).value == 0);
}

TEST_CASE("the initial profile is an equilibrium of (24): ε c'' = W'(c)/ε") {
    MoleculeParameters molecules;
    const double epsilon = molecules.interface_width, step = 1e-3;
    for (const double r : {34.0, 35.5, 36.0, 37.0}) {
        const auto c = [&](double x) { return initial_concentration(molecules, x); };
        const double second = (c(r + step) - 2 * c(r) + c(r - step)) / (step * step);
        CHECK(epsilon * second == Approx(double_well(c(r)).first / epsilon).margin(1e-6));
    }
    CHECK(initial_concentration(molecules, molecules.patch_radius) == 0.5);
}

TEST_CASE("the initial coat within a radius is the integral of its profile") {
    for (const double radius : {3.0, 36.0, 500.0}) {
        MoleculeParameters molecules;
        molecules.patch_radius = radius;
        double sum = 0;
        const double end = radius + 20;
        constexpr int pieces = 40000;
        const auto integrand = [&](double r) { return r * initial_concentration(molecules, r); };
        for (int i = 0; i < pieces; ++i) {
            const double begin = end * i / pieces, width = end / pieces;
            sum += width / 6 * (integrand(begin) + 4 * integrand(begin + width / 2) + integrand(begin + width));
            // Simpson's rule errs by 1e-14 of the whole here; the closed form's round-off is of the same size.
            if (i % 4001 == 0)
                CHECK(initial_coat_within(molecules, begin + width) == Approx(sum).margin(1e-11 * radius * radius));
        }
        CHECK(initial_coat_within(molecules, end) == Approx(sum).epsilon(1e-11));
    }
    MoleculeParameters sharp;
    sharp.interface_width = 1e-3;
    // δ²π²/6 beyond that of a step.
    CHECK(initial_coat_within(sharp, 80) ==
          Approx(0.5 * 36 * 36 + 0.5e-6 * std::numbers::pi * std::numbers::pi / 6).epsilon(1e-14));
}

TEST_CASE("concentrations are clipped to [0, 1]") {
    CHECK(clip_concentration(-0.1) == 0);
    CHECK(clip_concentration(0.4) == 0.4);
    CHECK(clip_concentration(1.2) == 1);
}
