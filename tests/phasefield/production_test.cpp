// The production scheme: its equations, its time discretisation, its conservation laws and its order in ε.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "one_step.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "run_steps.h"
#include "shared/geometry/observables.h"
#include "shared/numerics/bdf.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

StepNumbers numbers_of(const Parameters& p) {
    return step_numbers(p, 40, scheme_rates(p).profile_relaxation);
}

/// Reads a column of early.csv at the first row, 0.0005 µs.
double early_reference(std::size_t column) {
    std::ifstream file(std::string(ENDOFLOW_REFERENCE_DIR) + "/early.csv");
    std::string line, cell;
    for (int skip = 0; skip < 3; ++skip) std::getline(file, line);
    std::stringstream row(line);
    for (std::size_t i = 0; i <= column; ++i) std::getline(row, cell, ',');
    return std::stod(cell);
}

/// The volume of extracellular fluid the bud takes in per time at t → 0, standard case [nm³/µs].
double first_volume_rate(double epsilon, double cell_size) {
    Parameters p;
    p.phase_field.epsilon = epsilon;
    p.phase_field.cell_size = cell_size;
    p.molecules.interface_width = 2.4;
    p.time.tolerance = 1e-6;  // the iterations of so short a step end at 1e-2 of its motion with the default one
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    constexpr double tau = 1e-7;
    const auto outcome = scheme.attempt(0, tau);
    return measure(outcome.contour.curve, BendingModel(p.membrane)).extracellular_volume / tau;
}

/// The row of s over a₀ δ_Γ at a distance `psi` from a plane membrane that moves by `motion` nm along z in each of the
/// last steps, s = 1: what would change s, relative, in this step.
double change_of_stretch(const Parameters& p, double psi, double motion) {
    constexpr double tau = 1e-3;
    const auto bdf = bdf_coefficients(0, {-tau, -2 * tau, -3 * tau}, 3);
    StepNumbers step = numbers_of(p);
    step.rate = bdf.rate;
    const auto profile = [&](double at) { return layer_profile(at, p.phase_field.epsilon); };
    const auto row = [&](double z) {
        PointPast past;
        past.thickness.value = p.phase_field.epsilon;
        past.normal = past.molecules_normal = {0, -1};
        for (std::size_t j = 0; j < 3; ++j) {
            const double before = -z - static_cast<double>(j + 1) * motion;
            past.indicator += bdf.past[j] * H_Gamma(profile(before).phi, step.weight);
            past.stretching += bdf.past[j] * delta_Gamma(profile(before), step.weight);
        }
        Fields<double> x;
        x[distance] = {-z, 0, -1};
        x[velocity_z].value = motion / tau;
        x[membrane_stretch].value = 1;
        return point_equations(x, 7.0, past, {}, step, LayerEnergy(p))[membrane_stretch];
    };
    constexpr double h = 1e-4;
    const double divergence = (row(-psi + h).z - row(-psi - h).z) / (2 * h);
    return (row(-psi).value - divergence) / (bdf.rate * delta_Gamma(profile(psi), step.weight));
}

}  // namespace

TEST_CASE("what keeps G constant along the normal exerts no net force", "[production]") {
    // A translation of the membrane along z is u = e_z for the flow and χ = ∂ψ/∂z for G: the two powers are equal.
    const Parameters p;
    Fields<double> x{};
    x[distance] = {0.4, 0.5, -0.7};
    x[normal_force] = {0.3, 0.2, -0.6};
    PointPast past;
    past.thickness.value = p.phase_field.epsilon;
    const double chi_r = 2e-5, chi_z = 3e-5;  // so small that the force does not fade: by 4e-8 of itself
    const auto n = own_normal(x[distance], past);
    const GradientChange<double> change{0, n.r * chi_r + n.z * chi_z};
    const auto rows = point_equations(x, 7.0, past, change, numbers_of(p), LayerEnergy(p));
    const auto& own = rows[normal_force];
    const double aligned = own.r * chi_r + own.z * chi_z, force = own.value * x[distance].z + aligned;
    CHECK(std::abs(aligned) > 1e-5);
    // The floor of δ, 1e-8/nm times G ∂ψ/∂z, has no counterpart in the flow.
    CHECK(rows[velocity_z].value == Approx(-force).margin(1e-8));
}

TEST_CASE("backward differentiation is exact for polynomials of its order", "[production]") {
    const std::vector<double> times{0.9, 0.7, 0.2};
    const auto cubic = [](double t) { return 2 * t * t * t - t; };
    const auto square = [](double t) { return 3 * t * t - t + 4; };
    const auto bdf = bdf_coefficients(1.3, times, 2);
    CHECK(bdf.rate * square(1.3) + bdf.past[0] * square(0.9) + bdf.past[1] * square(0.7) ==
          Approx(6 * 1.3 - 1).epsilon(1e-13));
    const auto weights = extrapolation_weights(1.3, times, 3);
    double predicted = 0;
    for (std::size_t j = 0; j < 3; ++j) predicted += weights[j] * square(times[j]);
    CHECK(predicted == Approx(square(1.3)).epsilon(1e-13));

    // On a cubic the estimate of the error of BDF2 for y' = f(t) is exact.
    double guess = 0;
    for (std::size_t j = 0; j < 3; ++j) guess += weights[j] * cubic(times[j]);
    const double solved = (6 * 1.3 * 1.3 - 1 - bdf.past[0] * cubic(0.9) - bdf.past[1] * cubic(0.7)) / bdf.rate;
    CHECK(std::abs(solved - cubic(1.3)) ==
          Approx(std::abs(solved - guess) * error_fraction(1.3, times, 2)).epsilon(1e-12));
    CHECK(error_fraction(3, {2, 1, 0}, 2) == Approx(2.0 / 11).epsilon(1e-13));

    const auto third = bdf_coefficients(1.3, times, 3);
    CHECK(third.rate * cubic(1.3) + third.past[0] * cubic(0.9) + third.past[1] * cubic(0.7) +
              third.past[2] * cubic(0.2) ==
          Approx(6 * 1.3 * 1.3 - 1).epsilon(1e-13));
    CHECK(error_fraction(4, {3, 2, 1, 0}, 3) == Approx(3.0 / 25).epsilon(1e-13));
}

TEST_CASE("a plane membrane does not stretch however far it moves in a step", "[production]") {
    // Central differences, at 4 ε of terms that are 300 times the weight there: measured 2.6e-4 at 4 ε, at most 2e-5
    // nearer. With δ_Γ ∂ψ/∂t for the flux across, a motion of ε changes s by 0.07 (at −2 ε), 21 (2 ε) and 270 (4 ε),
    // with ∂H/∂t but H not cut off as δ_Γ is by 8e-4, 6e-3 and 75.
    const Parameters p;
    const double epsilon = p.phase_field.epsilon;
    for (const double motion : {0.1 * epsilon, epsilon})
        for (const double psi : {-2 * epsilon, -epsilon, 0.0, 0.5 * epsilon, 2 * epsilon, 4 * epsilon}) {
            CAPTURE(motion, psi);
            CHECK(std::abs(change_of_stretch(p, psi, motion)) < (psi > 3 * epsilon ? 1e-3 : 1e-4));
        }
}

TEST_CASE("the membrane's weight leaves no excess shear in the layer", "[production]") {
    FluidParameters fluid;
    fluid.viscosity_extracellular = 1e-3;
    for (const double ratio : {0.1, 1.0, 1.0005, 1.5, 5.0, 10.0, 30.0, 44.0})
        for (const ViscosityMean mean : {ViscosityMean::arithmetic, ViscosityMean::harmonic}) {
            fluid.viscosity_intracellular = ratio * 1e-3;
            const MembraneWeight weight = membrane_weight(fluid, mean);
            CHECK(membrane_indicator(1.0, weight) == Approx(0.5).epsilon(1e-14));  // ∫δ_Γ dψ = 1
            // Harmonic means of ratios above 7 are bounded by the smallest fluidity.
            if (mean == ViscosityMean::harmonic && std::abs(std::log(ratio)) > std::log(6)) continue;
            const ExcessShear excess = excess_shear(weight, fluid, mean);
            CHECK(excess.sum == Approx(0).margin(1e-9));  // roots found to 1e-11
            if (mean == ViscosityMean::arithmetic) CHECK(excess.moment == Approx(0).margin(1e-9));
        }
    // δ²/(δ + f) by the midpoint rule in ψ/(√2 ε) on a thousand points, the accuracy of which is round-off here.
    double kept = 0;
    for (int i = -500; i < 500; ++i) {
        const double well = std::pow(std::cosh(0.02 * (i + 0.5)), -4);
        kept += 0.02 * 0.75 * well * well / (well + tail_cut);
    }
    CHECK(cut_norm() * kept == Approx(1).epsilon(1e-10));
    // Between fluids of any ratio the viscosity stays above a fifth of the smaller one.
    for (const double ratio : {1e-3, 44.0, 60.0, 100.0, 1e3}) {
        fluid.viscosity_intracellular = ratio * 1e-3;
        const auto weight = membrane_weight(fluid, ViscosityMean::arithmetic);
        double smallest = 1;
        for (int i = -1000; i <= 1000; ++i)
            smallest = std::min(smallest, layer_viscosity(1e-3 * i, fluid, weight, ViscosityMean::arithmetic));
        CHECK(smallest >= 0.1999e-3 * std::min(1.0, ratio));
    }
}

TEST_CASE("the weight of what acts along the normal blurs no force", "[production]") {
    // By the midpoint rule, exact to the square of the interval, 1e-4, where |ψ| has its kink. The cut of the tails
    // takes 2e-4 (w₀ + w₂ + w₄ = 1.7 times that of δ's) where ψ² is 10 ε². δ has a second moment of 0.645 ε², a third
    // of 0.83 ε³.
    double whole = 0, second = 0, third = 0, wave = 0;
    constexpr double interval = 0.01, k = 0.2;  // wave number times ε
    for (int i = -2000; i < 2000; ++i) {
        const double psi = interval * (i + 0.5), distance = std::abs(psi),
                     part = interval * delta_N(layer_profile(psi, 1));
        whole += part;
        second += part * psi * psi;
        third += part * std::pow(distance, 3);
        wave += part * (1 + k * distance) * std::exp(-k * distance);
    }
    CHECK(whole == Approx(1).epsilon(5e-4));
    CHECK(second == Approx(0).margin(5e-3));
    CHECK(third == Approx(0).margin(2e-2));
    CHECK(wave == Approx(whole).epsilon(0.2 * std::pow(k, 4)));  // with δ it is 0.990
}

TEST_CASE("a small bud conserves its molecules, loses energy and keeps profile and area", "[production]") {
    Parameters p = small_case();
    p.phase_field.scheme = PhaseFieldScheme::production;
    ProductionScheme scheme(p, MPI_COMM_SELF);
    double time = 0, energy = scheme.start().diagnostics.bending_energy, power = 0, inflow = 0;
    Observables shape{};
    double put_right = 0;
    const double mass = scheme.integrate().molecules;
    for (int count = 0; count < 8; ++count) {
        const double begin = time;
        const auto outcome = take_step(scheme, time, 1);
        const double tau = time - begin;
        const auto& seen = outcome.diagnostics;
        const double loss = (energy - seen.bending_energy) / tau;
        const double power_before = power, inflow_before = inflow;
        power = seen.viscous_dissipation + seen.mobility_dissipation + seen.tension_power - seen.transport_power;
        // (21) with the power of the molecules' transport over the step, by the trapezoidal rule: 0.1 % is left.
        if (count > 4) CHECK(loss == Approx(0.5 * (power + power_before)).epsilon(0.003));
        // What flows in through the open walls is the volume that the membrane takes in, to the trapezoidal rule, and
        // the rim holds the membrane with a small force: at the speed of the bud it would take up 1.7 % of the power.
        const Observables before = shape;
        shape = measure(outcome.contour.curve, BendingModel(p.membrane));
        inflow = seen.extracellular_inflow;
        if (count > 4) {
            const double gain = (shape.extracellular_volume - before.extracellular_volume) / tau;
            CHECK(gain == Approx(0.5 * (inflow + inflow_before)).epsilon(0.01));
            CHECK(std::abs(seen.net_vertical_force) * (shape.bud_height - before.bud_height) / tau < 0.03 * power);
        }
        put_right += std::abs(seen.molecules_put_right);
        CHECK(seen.bending_energy < energy);
        energy = seen.bending_energy;
        CHECK(seen.profile_error_max < 0.01);  // the bound that users are told
        CHECK(seen.area_strain_max < 0.01);
    }
    // ∫δ c is conserved by the equations, but for what the iterations leave of their residual; that is put right.
    CHECK(put_right < 1e-7 * mass);
    CHECK(scheme.integrate().molecules == Approx(mass).epsilon(1e-12));
}

TEST_CASE("the membrane is known at any time of the last step", "[production]") {
    ProductionScheme scheme(small_case(), MPI_COMM_SELF);
    scheme.start();
    double time = 0;
    const auto height = [](const Contour& contour) { return contour.curve.z.front(); };
    std::vector<double> times, heights;
    for (int count = 0; count < 4; ++count) {
        const double tau = scheme.step(time, 1);
        const auto outcome = scheme.attempt(time, tau);
        REQUIRE(outcome.rejection.empty());
        scheme.keep(time, tau, outcome);
        time += tau;
        times.push_back(time);
        heights.push_back(height(outcome.contour));
    }
    // At the ends of the step it is the solution itself, within it the cubic through the last four.
    CHECK(height(scheme.contour_at(times[3])) == Approx(heights[3]).epsilon(1e-12));
    CHECK(height(scheme.contour_at(times[2])) == Approx(heights[2]).epsilon(1e-12));
    const double middle = 0.5 * (times[2] + times[3]);
    const auto weights = extrapolation_weights(middle, {times[3], times[2], times[1], times[0]}, 4);
    // ψ is interpolated, and its zero moves by less than 1e-6 of the height in a step.
    CHECK(height(scheme.contour_at(middle)) ==
          Approx(weights[0] * heights[3] + weights[1] * heights[2] + weights[2] * heights[1] + weights[3] * heights[0])
              .epsilon(1e-8));
}

TEST_CASE("the flow's first volume rate hardly depends on the layer's thickness", "[production]") {
    // The same case in the boundary-integral engine, one step of 1e-7 µs. Measured errors: 2.5e-3 at ε = 4.8 nm and
    // less than a third of that at 2.4 nm; with δ instead of δ_Γ as the membrane's weight they are some per cent.
    constexpr double sharp = 4.2811e5;
    CHECK(first_volume_rate(4.8, 1.25) == Approx(sharp).epsilon(3e-3));
    CHECK(first_volume_rate(2.4, 1.25) == Approx(sharp).epsilon(8e-4));
    // The cells that a run chooses, 1.4 ε: measured 1.3e-3, by the Gauss points; one less per direction gives 1e-2.
    CHECK(first_volume_rate(1.2, 5.0 / 3) == Approx(sharp).epsilon(3e-3));
}

TEST_CASE("the standard case starts like the sharp model in the production scheme", "[production]") {
    Parameters p;
    p.phase_field.cell_size = 1.6;
    p.time.initial_step = 5e-5;
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    double time = 0;
    Contour contour;
    while (time < 5e-4 * (1 - 1e-12)) {
        const double tau = scheme.step(time, 5e-4);
        const auto outcome = scheme.attempt(time, tau);
        REQUIRE(outcome.rejection.empty());
        scheme.keep(time, tau, outcome);
        contour = outcome.contour;
        time += tau;
    }
    const auto seen = measure(contour.curve, BendingModel(p.membrane));
    // Cells of 4/3 ε, first step of 5e-5 µs: measured 3 to 4 %.
    CHECK(seen.extracellular_volume == Approx(early_reference(2)).epsilon(0.06));
    CHECK(seen.bud_height == Approx(early_reference(4)).epsilon(0.06));
}

TEST_CASE("the table of unknowns has a row for each, in the order of the equations", "[production]") {
    for (unsigned int f = 0; f < n_fields; ++f) CHECK(unknowns()[f].field == f);
}

TEST_CASE("the scheme names each of its constants once", "[production]") {
    std::set<std::string> names;
    for (const auto& [name, value] : ProductionScheme(small_case(), MPI_COMM_SELF).constants()) {
        INFO(name);
        CHECK(names.insert(name).second);
        CHECK(std::isfinite(value));
    }
    CHECK(names.contains("weight_cut"));
}
