// Molecules that bending and line energy drive, and molecules that come and go, in the production scheme.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "flat_case.h"
#include "phasefield/driver/molecule_balance.h"
#include "run_steps.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

TEST_CASE("energetic coupling: E + E_c falls by what fluid and molecules dissipate", "[molecules]") {
    Parameters p = small_case();
    p.molecules.coupling = Coupling::energetic;
    p.molecules.line_energy = 80;
    p.molecules.mobility =
        GENERATE(2000.0, 64000.0);  // the default was noise while μ was free to vary across the layer
    ProductionScheme scheme(p, MPI_COMM_SELF);
    const StepOutcome start = scheme.start();
    // A flat edge costs σ̂ √2/6 per length; around a disc of 16 nm with an edge of 3 nm it is 1 % more.
    const double edge = 80 * std::numbers::sqrt2 / 6 * 2 * std::numbers::pi * p.molecules.patch_radius;
    CHECK(start.diagnostics.line_energy == Approx(edge).epsilon(0.02));
    const double mass = scheme.integrate().molecules;
    double energy = start.diagnostics.bending_energy + start.diagnostics.line_energy, power = 0;
    int count = 0;
    run_steps(scheme, 3e-4, [&](double, double tau, const StepOutcome& outcome) {
        const auto& seen = outcome.diagnostics;
        const double now = seen.bending_energy + seen.line_energy, before = power;
        power = seen.viscous_dissipation + seen.tension_power + seen.molecule_dissipation;
        CHECK(now < energy);
        // At the default mobility the power falls by a third in a step: its mean is that of an exponential.
        if (++count > 4) {
            CHECK((energy - now) / tau == Approx((power - before) / std::log(power / before)).epsilon(0.03));
            if (p.molecules.mobility == 2000)
                CHECK((energy - now) / tau == Approx(0.5 * (power + before)).epsilon(0.03));
        }
        // Transport's power is what diffusion dissipates.
        if (count > 4) CHECK(seen.transport_power == Approx(-seen.molecule_dissipation).margin(0.03 * power));
        energy = now;
    });
    CHECK(count > 6);
    CHECK(scheme.integrate().molecules == Approx(mass).epsilon(1e-12));
}

TEST_CASE("molecules do not crowd within a cell where the energy depends strongly on them", "[molecules]") {
    // The coarse-grained law's c ∂e/∂c is seven times the linear one's at c = 1. Without a diffusivity of the stretch
    // that follows it, strain grew by e in 10⁻⁴ µs, to a tenth in 10⁻³ µs.
    Parameters p = small_case();
    p.molecules.transport = Transport::advection;
    p.membrane.constitutive_law = ConstitutiveLaw::coarse_grained;
    p.membrane.bending_stiffness_coated = 1500;
    p.membrane.spontaneous_curvature = 0.08;
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    double largest = 0;
    run_steps(scheme, 1e-3, [&](double, double, const StepOutcome& outcome) {
        largest = std::max(largest, outcome.diagnostics.area_strain_max);
    });
    CHECK(largest < 2e-3);
}

TEST_CASE("a flat coat takes molecules from a reservoir at the rate k_on + k_off", "[molecules]") {
    Parameters p = flat_case(1e-4, 1e-4);
    p.molecules.exchange = Exchange::reservoir;
    p.molecules.on_rate = 200;
    p.molecules.off_rate = 100;
    p.time.initial_step = 2e-5;
    p.membrane.spontaneous_curvature = 5e-3;  // in so short a first step it must move by more than round-off
    ProductionScheme scheme(p, MPI_COMM_SELF);
    const StepOutcome start = scheme.start();
    MoleculeBalance balance;
    balance.start(scheme.integrate().molecules, start.diagnostics.exchange_rate);
    constexpr double end = 1e-3;
    double pole = 0, rim = 0;
    run_steps(scheme, end, [&](double time, double, const StepOutcome& outcome) {
        balance.advance(time, outcome.diagnostics.exchange_rate, outcome.diagnostics.molecules_put_right);
        pole = outcome.contour.curve.c.front();
        rim = outcome.contour.curve.c.back();
    });
    // c → 2/3 as exp(−0.3) from 1 and from 0. The balance is off by the first step, an Euler step of τ: ½ (300 τ/µs)²
    // of three times the coat, 1e-4; with τ = 1e-4 µs it was 1.8e-3.
    CHECK(pole == Approx(2.0 / 3 + std::exp(-0.3) / 3).epsilon(2e-3));
    CHECK(rim == Approx(2.0 / 3 * (1 - std::exp(-0.3))).epsilon(2e-3));
    CHECK(balance.residual(scheme.integrate().molecules) < 1e-3);
}
