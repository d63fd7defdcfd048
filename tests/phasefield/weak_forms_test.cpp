// The pointwise functions: the printed energy, derivatives against finite differences, limits.

#include <catch2/catch.hpp>
#include <cmath>

#include "phasefield/schemes/paper/bending.h"
#include "phasefield/schemes/paper/interface_geometry.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::paper;

TEST_CASE("as printed, the energy density is that of (5)", "[weak_forms]") {
    const MembraneParameters membrane;  // b = (1 + 11 c) b_m, H0 = c/14.1 nm
    const BendingModel model(membrane);
    const double epsilon = 1.3, c = 0.7, phi = 0.35, laplacian = -0.41;
    const auto b = bending_coefficients(model, c);
    const double f = epsilon * laplacian - well_force(phi, b.curvature, epsilon).value;
    const double printed_b = (1 + 11 * c) * 100, printed_H0 = c * membrane.spontaneous_curvature;
    const double printed_f =
        epsilon * laplacian - (phi * phi - 1) * (phi + std::sqrt(2.0) * epsilon * printed_H0) / epsilon;
    const double printed = 0.5 * 3 / (4 * std::sqrt(2.0) * epsilon) * printed_b * printed_f * printed_f;
    CHECK(f == Approx(printed_f).epsilon(1e-14));
    CHECK(energy_density(b.stiffness * f, b.stiffness, epsilon) == Approx(printed).epsilon(1e-13));
}

TEST_CASE("derivatives of F and of the force on ∇c agree with central differences", "[weak_forms]") {
    const double epsilon = 1.7, C = 0.11, phi = -0.4, h = 1e-5;
    const auto F = [&](double x) { return well_force(x, C, epsilon); };
    CHECK(F(phi).phi == Approx((F(phi + h).value - F(phi - h).value) / (2 * h)).epsilon(1e-8));
    CHECK(F(phi).phiphi == Approx((F(phi + h).phi - F(phi - h).phi) / (2 * h)).epsilon(1e-8));
    const double by_C = (well_force(phi, C + h, epsilon).value - well_force(phi, C - h, epsilon).value) / (2 * h);
    CHECK(F(phi).curvature == Approx(by_C).epsilon(1e-8));

    const BendingModel model{MembraneParameters{}};
    const double c = 0.4, laplacian = 0.2, m = 31;
    // e is the derivative of the energy density with respect to c at fixed φ.
    const auto density = [&](double x) {
        const auto b = bending_coefficients(model, x);
        const double f = epsilon * laplacian - well_force(phi, b.curvature, epsilon).value;
        return energy_density(b.stiffness * f, b.stiffness, epsilon);
    };
    const auto b = bending_coefficients(model, c);
    const double f = epsilon * laplacian - well_force(phi, b.curvature, epsilon).value;
    const auto e = concentration_force(phi, b.stiffness * f, b, epsilon);
    CHECK(e.value == Approx((density(c + h) - density(c - h)) / (2 * h)).epsilon(1e-7));
    const auto at = [&](double x, double y) { return concentration_force(x, y, b, epsilon).value; };
    CHECK(concentration_force(phi, m, b, epsilon).moment ==
          Approx((at(phi, m + h) - at(phi, m - h)) / (2 * h)).epsilon(1e-6));
    CHECK(concentration_force(phi, m, b, epsilon).phi ==
          Approx((at(phi + h, m) - at(phi - h, m)) / (2 * h)).epsilon(1e-6));
}

namespace {

/// (D) of the tanh profile around a sphere (dimension 3) or a cylinder (2), by the midpoint rule; per unit length for
/// the cylinder.
double diffuse_energy(double radius, int dimension, double stiffness, double curvature, double epsilon) {
    const int n = 40000;
    const double reach = 12 * epsilon, step = 2 * reach / n, steepness = 1 / (std::sqrt(2.0) * epsilon);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double r = radius - reach + (i + 0.5) * step, phi = equilibrium_profile(radius - r, epsilon);
        const double slope = -steepness * (1 - phi * phi), second = -2 * steepness * steepness * phi * (1 - phi * phi);
        const double laplacian = second + (dimension - 1) / r * slope;
        const double f = epsilon * laplacian - well_force(phi, curvature, epsilon).value;
        const double shell = dimension == 3 ? 4 * M_PI * r * r : 2 * M_PI * r;
        sum += step * shell * energy_density(stiffness * f, stiffness, epsilon);
    }
    return sum;
}

}  // namespace

TEST_CASE("(D) converges to (S) with the second order in ε on spheres and cylinders", "[weak_forms]") {
    const double radius = 20, stiffness = 600, C = 0.14;
    for (const int dimension : {2, 3}) {
        const double kappa = (dimension - 1) / radius;
        const double area = dimension == 3 ? 4 * M_PI * radius * radius : 2 * M_PI * radius;
        const double sharp = 0.5 * stiffness * (kappa - C) * (kappa - C) * area;
        const double coarse = std::abs(diffuse_energy(radius, dimension, stiffness, C, 1.0) - sharp);
        const double fine = std::abs(diffuse_energy(radius, dimension, stiffness, C, 0.5) - sharp);
        INFO("dimension " << dimension << ": errors " << coarse << ", " << fine << " of " << sharp);
        CHECK(std::log2(coarse / fine) == Approx(2).margin(0.05));
        CHECK(fine < 0.01 * sharp);  // ε/R = 1/40, squared, times a constant of order ten
    }
}

TEST_CASE("the layer's geometry and viscosity have their limits", "[weak_forms]") {
    const auto layer = layer_geometry(0.3, -0.4, 1.2);
    CHECK(layer.gradient == Approx(0.5));
    CHECK(layer.P_rr + layer.P_zz == Approx(1).margin(1e-6));  // trace of P in the plane, up to the floor
    const auto nowhere = layer_geometry(0, 0, 1.2);
    CHECK(nowhere.P_rr == 1);
    CHECK(nowhere.P_zz == 1);
    const FluidParameters fluid;
    for (const auto mean : {ViscosityMean::arithmetic, ViscosityMean::harmonic}) {
        CHECK(viscosity(1.1, fluid, mean) == Approx(1e-3));   // extracellular
        CHECK(viscosity(-1.1, fluid, mean) == Approx(1e-2));  // intracellular
    }
    // A sphere of extracellular fluid: φ grows inwards, ∇·n = −2/R for n along ∇φ.
    const double R = 15, r = 9, z = 12;
    const LevelSetPoint sphere{
        0, -r / R, -z / R, -1 / R + r * r / (R * R * R), r * z / (R * R * R), -1 / R + z * z / (R * R * R)};
    CHECK(normal_divergence(sphere, r, 0) == Approx(-2 / R).epsilon(1e-12));
}
