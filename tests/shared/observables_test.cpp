#include "shared/geometry/observables.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace endoflow;
using std::numbers::pi;

namespace {

const BendingModel default_model{MembraneParameters{}};

MembraneCurve curve_of(int points, double t_end, double (*r)(double), double (*z)(double), double (*kappa)(double)) {
    MembraneCurve curve;
    for (int i = 0; i < points; ++i) {
        const double t = t_end * i / (points - 1);
        curve.r.push_back(r(t));
        curve.z.push_back(z(t));
        curve.kappa.push_back(kappa(t));
    }
    curve.r.front() = 0;
    curve.c.assign(curve.r.size(), 0.0);
    return curve;
}

/// Spherical cap of radius 20 nm, polar angle 0 … 0.75π, so that it narrows towards its rim.
MembraneCurve sphere_cap(int points) {
    return curve_of(
        points, 0.75 * pi, [](double t) { return 20 * std::sin(t); }, [](double t) { return 20 * std::cos(t); },
        [](double) { return 2.0 / 20; });
}

/// A smooth bud: r = 30 t + 25 sin 2πt has a widest and a narrowest place in closed form.
constexpr double amplitude = 25, slope = 30;
double bud_r(double t) {
    return slope * t + amplitude * std::sin(2 * pi * t);
}
double bud_z(double t) {
    return 40 * std::cos(0.5 * pi * t) * std::cos(0.5 * pi * t);
}

}  // namespace

TEST_CASE("the height of a bud with a dimple on the axis does not depend on round-off") {
    // Highest between the axis and the first point. On the axis dz/dt is zero, with a sign that is left to chance.
    const std::vector<double> z{1.619085, 1.619138, 1.615686, 1.594374, 1.526711, 1.383803,
                                1.150298, 0.838673, 0.516315, 0.276543, 0.159163, 0.122042,
                                0.102058, 0.075863, 0.046210, 0.016716, 0};
    MembraneCurve curve;
    curve.z = z;
    curve.c = curve.kappa = std::vector<double>(z.size(), 0.0);
    for (std::size_t i = 0; i < z.size(); ++i) curve.r.push_back(2.5 * static_cast<double>(i));
    const double height = measure(curve, default_model).bud_height;
    CHECK(height > z[1] + 2e-5);
    CHECK(height < z[1] + 1e-4);
    for (int shift = 1; shift <= 40; ++shift) {
        MembraneCurve raised = curve;
        for (double& value : raised.z) value += 0.1 * shift;
        // Heights of 6 nm have a round-off of 1e-15 nm, and the height is a smooth function of them.
        CHECK(measure(raised, default_model).bud_height == Approx(height).epsilon(1e-12));
    }
}

TEST_CASE("a mirrored membrane has the opposite height and volume and is the same otherwise") {
    const auto curve = curve_of(201, 1.0, bud_r, bud_z, [](double) { return 0.3; });
    MembraneCurve mirrored = curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        mirrored.z[i] = -curve.z[i];
        mirrored.kappa[i] = -curve.kappa[i];
    }
    MembraneParameters membrane, mirrored_membrane;
    mirrored_membrane.spontaneous_curvature = -membrane.spontaneous_curvature;
    const auto bud = measure(curve, BendingModel(membrane)), other = measure(mirrored, BendingModel(mirrored_membrane));
    CHECK(bud.bud_height > 30);
    CHECK(other.bud_height == -bud.bud_height);
    CHECK(other.extracellular_volume == -bud.extracellular_volume);
    CHECK(other.neck.value().radius == bud.neck.value().radius);
    CHECK(other.neck.value().lateral_diameter == bud.neck.value().lateral_diameter);
    CHECK(other.membrane_area == bud.membrane_area);
    CHECK(other.molecule_mass == bud.molecule_mass);
    CHECK(other.bending_energy == Approx(bud.bending_energy).epsilon(1e-14));
}

TEST_CASE("area, energy and volume of a spherical cap converge with order 4") {
    const double radius = 20, angle = 0.75 * pi, height = radius * (1 - std::cos(angle));
    const double area = 2 * pi * radius * height;
    const double volume = pi * height * height * (3 * radius - height) / 3;
    const double energy = 0.5 * 50 * (2 / radius) * (2 / radius) * area;  // β(0) = b_m/2, C(0) = 0
    const auto coarse = measure(sphere_cap(41), default_model), fine = measure(sphere_cap(81), default_model);
    // The far end of the spline is natural, a local O(h²) error in curvature: order ≥ 3 overall in area and volume.
    const double order = std::log2(std::abs(coarse.membrane_area - area) / std::abs(fine.membrane_area - area));
    CHECK(order > 2.8);
    CHECK(fine.membrane_area == Approx(area).epsilon(1e-5));
    CHECK(fine.extracellular_volume == Approx(volume).epsilon(1e-5));
    CHECK(fine.bending_energy == Approx(energy).epsilon(1e-5));
    CHECK(fine.bud_height == Approx(height).epsilon(1e-12));
    CHECK(fine.molecule_mass == 0);
}

TEST_CASE("the neck and the lateral diameter of a bud are found between samples") {
    const double cosine = -slope / (2 * pi * amplitude);  // r' = 0 at 2πt = ±acos(cosine)
    const double t_wide = std::acos(cosine) / (2 * pi), t_neck = 1 - t_wide;
    const auto curve = curve_of(201, 1.0, bud_r, bud_z, [](double) { return 0.0; });
    const auto neck = measure(curve, default_model).neck;
    REQUIRE(neck.has_value());
    // Cubic spline with 200 intervals: (1/200)⁴ times fourth derivatives of order (2π)⁴·25 / 384 gives 7e-8 nm.
    CHECK(neck->radius == Approx(bud_r(t_neck)).margin(1e-6));
    CHECK(neck->lateral_diameter == Approx(2 * bud_r(t_wide)).margin(1e-6));
}

TEST_CASE("a membrane that widens all the way has no neck, and a flat one no height, energy or volume") {
    const auto flat = curve_of(
        50, 80.0, [](double t) { return t; }, [](double) { return 80.0; }, [](double) { return 0.0; });
    const auto result = measure(flat, default_model);
    CHECK_FALSE(result.neck.has_value());
    CHECK(result.bud_height == 0);
    CHECK(result.membrane_area == Approx(pi * 6400).epsilon(1e-13));
    CHECK(result.bending_energy == 0);
    CHECK(result.extracellular_volume == 0);
}

TEST_CASE("a curve that is no membrane is refused") {
    MembraneCurve curve;
    CHECK_THROWS_AS(measure(curve, default_model), std::invalid_argument);
    auto shifted = sphere_cap(20);
    shifted.r.front() = 3;
    CHECK_THROWS_AS(measure(shifted, default_model), std::invalid_argument);
    auto repeated = sphere_cap(20);
    repeated.r[5] = repeated.r[4];
    repeated.z[5] = repeated.z[4];
    CHECK_THROWS_AS(measure(repeated, default_model), std::invalid_argument);
}
