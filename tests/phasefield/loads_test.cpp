// Rim tension, pressure and vertical forces on the layer: their virtual work, and the energy law of a run.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "flat_case.h"
#include "one_step.h"
#include "phasefield/schemes/production/external_loads.h"
#include "run_steps.h"
#include "shared/geometry/observables.h"
#include "shared/model/initial_condition.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

using std::numbers::pi;

/// ∫ c dA of the flat membrane.
double coat_of(const Parameters& p) {
    return 2 * pi * initial_coat_within(p.molecules, p.domain.radius);
}

/// The loads' power on the flat membrane of the small case when the velocity is u_r(r), u_z(r).
template <class Radial, class Axial>
double power(const Parameters& p, const Radial& u_r, const Axial& u_z) {
    const OneStep one(p);
    StepNumbers numbers = step_numbers(p, 2000, 1000);
    MembraneCurve membrane;
    for (double r = 0; r <= p.domain.radius; r += 0.125) {
        membrane.r.push_back(r);
        membrane.z.push_back(p.domain.membrane_height);
    }
    numbers.coat_force = p.membrane.coat_force / coat_of(p);
    numbers.material_force = std::make_shared<const MaterialForce>(membrane, numbers.loads);
    Vector x = one.space.vector();
    interpolate(
        one.space, distance, [&](double, double z) { return p.domain.membrane_height - z; }, x);
    interpolate(
        one.space, velocity_r, [&](double r, double) { return u_r(r); }, x);
    interpolate(
        one.space, velocity_z, [&](double r, double) { return u_z(r); }, x);
    interpolate(
        one.space, molecule_density, [&](double r, double) { return initial_concentration(p.molecules, r); }, x);
    finish_interpolation(one.space, x);
    x.update_ghost_values();
    const std::vector<Vector> past{x};
    past.front().update_ghost_values();
    const StepPast history(one.space, numbers, past, {-2000}, {1}, past.front());
    return load_power({one.space, one.energy, numbers, history}, x);
}

}  // namespace

TEST_CASE("every load does its virtual work", "[loads]") {
    // δG = σ δA − p δV − F δz̄ of the flat membrane: exact integrals. Gauss points on cells of ε leave some 1e-4 of the
    // integral of δ_Γ across the layer.
    Parameters none = small_case();
    none.phase_field.far_refinements = 0;
    const double R = none.domain.radius;
    const auto bulge = [&](double r) { return 3 * (1 - r * r / (R * R)); };
    const auto inwards = [&](double r) { return -2 * r / R; };
    CHECK(power(none, inwards, bulge) == 0);

    Parameters tension = none;
    tension.membrane.rim_tension = 0.05;
    CHECK(power(tension, inwards, bulge) == Approx(-0.05 * 2 * pi * R * 2).epsilon(1e-3));

    Parameters pressure = none;
    pressure.fluid.pressure_difference = 0.01;
    CHECK(power(pressure, inwards, bulge) == Approx(0.01 * 3 * pi * R * R / 2).epsilon(1e-3));

    Parameters force = none;
    force.membrane.pole_force = 20;
    // 3 F ∫ (1 − r²/R²) exp(−r²/w²) 2r dr/w², which is 1e-28 beyond the rim.
    const double w = force.membrane.pole_force_width;
    CHECK(power(force, inwards, bulge) == Approx(20 * 3 * (1 - w * w / (R * R))).epsilon(1e-3));

    // 3 F_a (⟨1 − r²/R²⟩ over the coat minus over the ring); in area the ring's share is symmetric about its middle.
    Parameters coat = none;
    coat.membrane.coat_force = 20;
    double squares = 0;  // ∫ c r² r dr
    for (double r = 0.05; r < R; r += 0.1) squares += 0.1 * r * r * r * initial_concentration(coat.molecules, r);
    const double over_coat = 1 - squares / initial_coat_within(coat.molecules, R) / (R * R);
    CHECK(power(coat, inwards, bulge) == Approx(60 * over_coat).epsilon(1e-3));
    coat.membrane.coat_force_ring = {0.6 * R, 0.9 * R};
    const double over_ring = 1 - 0.5 * (0.36 + 0.81);
    CHECK(power(coat, inwards, bulge) == Approx(60 * (over_coat - over_ring)).epsilon(2e-3));
    CHECK(std::abs(power(coat, inwards, [](double) { return 3.0; })) < 60e-3);  // no net force

    // 2 F_d r̄/R, r̄ the mean of √(A₀/π) over the Gaussian in A₀: a (1 − ⅛ (s/πa²)²) to 1e-5.
    Parameters collar = none;
    collar.membrane.collar_force = 20;
    collar.membrane.collar_position = 0.6 * R;
    const double a = 0.6 * R, spread = loads_of(collar).collar_spread() / (pi * a * a);
    CHECK(power(collar, inwards, bulge) == Approx(40 * a / R * (1 - spread * spread / 8)).epsilon(1e-3));
}

TEST_CASE("the fluid that a pressure drives past the rim follows the pin band's width between the cells' edges",
          "[loads]") {
    // 2.6 % less from the first to the last; nodes lie within 0.09 nm of the band's end, which is worth 0.2 %. Nodes of
    // the layer's cells, 2.5 nm wide, would hold the same width in the first two.
    const auto volume = [](double half_width) {
        Parameters p = flat_case(1e-4, 1e-4);
        p.fluid.pressure_difference = 0.01;
        p.domain.pin_half_width = half_width;
        ProductionScheme scheme(p, MPI_COMM_SELF);
        scheme.start();
        double time = 0;
        const StepOutcome outcome = take_step(scheme, time, 1e-4);
        return measure(outcome.contour.curve, BendingModel(p.membrane)).extracellular_volume;
    };
    const double narrow = volume(4.4), wide = volume(5.0);
    CAPTURE(narrow, wide);
    CHECK(narrow > 1.02 * wide);
    CHECK(volume(4.7) == Approx(0.5 * (narrow + wide)).epsilon(0.002));
}

/// Checks (21) with the powers of loads and maturation over a short run, by the trapezoidal rule as without them;
/// returns the last step.
StepOutcome with_energy_law(const Parameters& p) {
    ProductionScheme scheme(p, MPI_COMM_SELF);
    double energy = scheme.start().diagnostics.bending_energy, loss_rate = 0;
    int count = 0;
    StepOutcome last;
    run_steps(scheme, 3e-4, [&](double, double tau, const StepOutcome& outcome) {
        const auto& seen = outcome.diagnostics;
        const double before = loss_rate, loss = (energy - seen.bending_energy) / tau;
        loss_rate = seen.viscous_dissipation + seen.tension_power - seen.transport_power - seen.load_power -
                    seen.maturation_power;
        if (++count > 4) CHECK(loss == Approx(0.5 * (loss_rate + before)).epsilon(0.005));
        energy = seen.bending_energy;
        last = outcome;
    });
    CHECK(count > 6);
    return last;
}

TEST_CASE("a bud under loads obeys the energy law, and the rim has its tension", "[loads]") {
    Parameters p = small_case();
    p.membrane.rim_tension = 0.5;
    p.fluid.pressure_difference = 0.01;
    p.membrane.pole_force = 20;
    p.membrane.coat_force = 20;
    p.membrane.coat_force_ring = {0.6 * p.domain.radius, 0.95 * p.domain.radius};
    p.membrane.collar_force = 10;
    p.membrane.collar_position = 0.6 * p.domain.radius;
    const StepOutcome last = with_energy_law(p);
    CHECK(last.contour.curve.lambda.back() == Approx(0.5).epsilon(0.1));
    CHECK(last.diagnostics.load_power > 0);
}

TEST_CASE("a coat that matures obeys the energy law", "[maturation]") {
    Parameters p = small_case();
    p.molecules.maturation = Maturation::cooperative;
    p.molecules.maturation_rate = 1000;  // within the run
    p.molecules.maturation_start = 0.3;
    CHECK(with_energy_law(p).diagnostics.maturation_power > 0);
}
