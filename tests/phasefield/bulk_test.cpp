// Molecules that come from a fluid which they deplete.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "../shared/temporary_directory.h"
#include "flat_case.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/production/bulk_transport.h"
#include "run_steps.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

/// A membrane that moves little, with molecules that come from a reservoir.
Parameters exchanging_case() {
    Parameters p = flat_case(5e-3, 2e-5);
    p.molecules.exchange = Exchange::reservoir;
    p.molecules.on_rate = 200;
    p.molecules.off_rate = 100;
    p.molecules.molecule_area = 50;
    return p;
}

/// The fluid above such a membrane holds this much coat per area of membrane.
void add_bulk(Parameters& p, double coats, double diffusivity) {
    p.molecules.bulk = Bulk::intracellular;
    p.molecules.bulk_diffusivity = diffusivity;
    const double height = p.domain.height - p.domain.membrane_height;
    p.molecules.bulk_concentration = coats / (p.molecules.molecule_area * height);
}

/// ∫ c dA after a run to `end` µs [nm²].
double mass_after(const Parameters& p, double end) {
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    run_steps(scheme, end, [](double, double, const StepOutcome&) {});
    return scheme.integrate().molecules;
}

/// A bare flat membrane at rest, a few cells wide, that takes up all the molecules it meets at `speed` K [nm/µs], D
/// ∂_z C = K C: the bulk alone.
class RestingMembrane {
  public:
    RestingMembrane(const Parameters& parameters, double speed)
        : parameters_(with_speed(parameters, speed)),
          mesh_(coarse_mesh(parameters_, MPI_COMM_SELF)),
          space_(*mesh_, field_degrees(parameters_.phase_field)),
          energy_(parameters_),
          numbers_(CaseNumbers(parameters_), 0),
          bulk_(parameters_, *mesh_, MPI_COMM_SELF) {
        mesh_->refine_global(static_cast<unsigned int>(parameters_.phase_field.far_refinements));
        space_.distribute();
        close_constraints(space_, parameters_);
        membrane_ = space_.vector();
        interpolate(
            space_, distance, [&](double, double z) { return parameters_.domain.membrane_height - z; }, membrane_);
        finish_interpolation(space_, membrane_);
        const BdfCoefficients none{};
        bulk_.start({space_, energy_, numbers_, none, membrane_}, first_mass_);
    }

    /// Steps of `tau` µs; returns what was measured last.
    BulkMeasures advance(int steps, double tau) {
        BulkMeasures out;
        for (int k = 0; k < steps; ++k) {
            const auto bdf = bdf_coefficients(times_.front() + tau, times_, std::min<std::size_t>(3, times_.size()));
            numbers_.rate = bdf.rate;
            const BulkStep step{space_, energy_, numbers_, bdf, membrane_};
            numbers_.supply = bulk_.foresee(step);
            const double speed = parameters_.molecules.on_rate * supply();
            const double mass =
                (area() * speed - std::inner_product(bdf.past.begin(), bdf.past.end(), masses_.begin(), 0.0)) /
                bdf.rate;
            out = bulk_.take(step, masses_, mass, tau);
            bulk_.keep(4);
            masses_.insert(masses_.begin(), mass);
            times_.insert(times_.begin(), times_.front() + tau);
        }
        return out;
    }

    [[nodiscard]] double area() const { return std::numbers::pi * std::pow(parameters_.domain.radius, 2); }
    [[nodiscard]] double coat() const { return masses_.front() - first_mass_; }  // that has come [nm²]
    [[nodiscard]] double coat_of_volume() const {                                // a₀c_∞ [1/nm]
        return parameters_.molecules.molecule_area * parameters_.molecules.bulk_concentration;
    }

  private:
    static Parameters with_speed(Parameters p, double speed) {
        p.molecules.on_rate = speed * p.molecules.molecule_area * p.molecules.bulk_concentration;
        return p;
    }

    /// At the middle of the membrane.
    [[nodiscard]] double supply() const {
        const dealii::Quadrature<2> corner(dealii::Point<2>(0, 0));
        SupplyAtPoints at_corner(numbers_.supply, corner);
        for (const auto& cell : space_.dofs.active_cell_iterators()) {
            const CellBox box = cell_box(cell);
            if (box.r0 == 0 && std::abs(box.z0 - parameters_.domain.membrane_height) < 1e-9)
                return at_corner.on(cell, box).front();
        }
        throw std::logic_error("no cell begins at the membrane");
    }

    static constexpr double first_mass_ = 1;
    Parameters parameters_;
    std::unique_ptr<Mesh> mesh_;
    Space space_;
    LayerEnergy energy_;
    StepNumbers numbers_;
    BulkTransport bulk_;
    Vector membrane_;
    std::vector<double> masses_{first_mass_}, times_{0};
};

/// A strip of the half space above a membrane at z = 20 nm, so little concentrated that the membrane stays bare.
Parameters half_space(double epsilon) {
    Parameters p;
    p.domain.radius = 2.5;
    p.domain.membrane_height = 20;
    p.domain.height = 100;
    p.phase_field.epsilon = epsilon;
    p.phase_field.cell_size = epsilon / 2.4 * 2.5;
    p.phase_field.far_refinements = 1;
    p.phase_field.production.thinning = 0;
    p.molecules.exchange = Exchange::reservoir;
    p.molecules.molecule_area = 50;
    p.molecules.bulk = Bulk::intracellular;
    p.molecules.bulk_diffusivity = 50;
    p.molecules.bulk_concentration = 1e-9;
    return p;
}

/// Relative error of what a membrane that takes up at the speed K has taken from a half space after `time` µs: its
/// surface then has c_b/c_∞ = exp(x²) erfc(x), x = K √(t/D).
double uptake_error(double epsilon, double speed, double time) {
    const Parameters p = half_space(epsilon);
    RestingMembrane membrane(p, speed);
    // At the start it goes with the root of time, which is no polynomial: the steps grow, from 3e-5 of it on.
    constexpr int steps = 60;
    constexpr double growth = 1.15;
    for (int k = 0; k < steps; ++k)
        membrane.advance(1, time * (growth - 1) * std::pow(growth, k) / (std::pow(growth, steps) - 1));
    const double D = p.molecules.bulk_diffusivity, x = speed * std::sqrt(time / D);
    const double at_surface = x < 5 ? std::exp(x * x) * std::erfc(x) : 1 / (x * std::sqrt(std::numbers::pi));
    const double taken = D / speed * (at_surface - 1 + 2 * x / std::sqrt(std::numbers::pi));
    return membrane.coat() / (membrane.area() * membrane.coat_of_volume() * taken) - 1;
}

}  // namespace

TEST_CASE("a membrane takes up what diffuses to it", "[bulk]") {
    const double speed = GENERATE(2.0, 1000.0);
    const double coarse = uptake_error(2.4, speed, 4), fine = uptake_error(1.2, speed, 4);
    INFO("K = " << speed << ": " << coarse << " " << fine);
    // The layer's error, of second order. At 1000 nm/µs the membrane takes up all that comes.
    CHECK(std::abs(fine) < 0.005);
    CHECK(std::abs(coarse) > 3.5 * std::abs(fine));
}

TEST_CASE("walls beyond which the bulk is never depleted supply the membrane", "[bulk]") {
    // At rest in a thin strip, D d'' = (2/R) (D/ℓ) d with D d' = D d/ℓ at the top, y = 0, and K (1 − d) at the
    // membrane.
    Parameters p = half_space(2.4);
    p.molecules.bulk_reach = 2000;
    const double height = p.domain.height - p.domain.membrane_height, speed = 0.5;
    const double reach = p.molecules.bulk_reach, kappa = std::sqrt(2 / (p.domain.radius * reach));
    const double grown = std::cosh(kappa * height), slope = std::sinh(kappa * height), top = 1 / (kappa * reach);
    const double letting = p.molecules.bulk_diffusivity * kappa * (slope + top * grown) / (grown + top * slope);
    RestingMembrane membrane(p, speed);
    BulkMeasures seen;
    for (int k = 0; k < 12; ++k) seen = membrane.advance(1, std::pow(3.0, k));
    CHECK(seen.supply == Approx(1 / (1 + speed / letting)).epsilon(1e-3));
    CHECK(seen.residual < 1e-10);
}

TEST_CASE("a bulk that is mixed at once is a pool, and a large one is the reservoir", "[bulk]") {
    Parameters p = exchanging_case();
    constexpr double end = 1e-3;
    const double without = mass_after(p, end), area = std::numbers::pi * std::pow(p.domain.radius, 2);
    const double first = mass_after(p, 0);
    // Langmuir's law is linear in c: dm/dt = k_on b (A − m) − k_off m whatever c is where, b = 1 − (m − m₀)/m_bulk.
    const auto mixed = [&](double bulk) {
        const auto rate = [&](double m) {
            return p.molecules.on_rate * (1 - (m - first) / bulk) * (area - m) - p.molecules.off_rate * m;
        };
        double m = first;
        constexpr int steps = 1000;
        const double tau = end / steps;
        for (int k = 0; k < steps; ++k) m += tau * rate(m + 0.5 * tau * rate(m));  // midpoint rule
        return m;
    };
    const auto with = [&](double coats) {
        Parameters q = p;
        add_bulk(q, coats, 1e9);
        return mass_after(q, end);
    };
    INFO("gain " << without - first << " of " << first);
    // The first step is one of Euler's: 1e-4 of the coat, as without a bulk.
    CHECK(with(0.3) - first == Approx(mixed(0.3 * area) - first).epsilon(2e-3));
    CHECK(without - first == Approx(mixed(1e12) - first).epsilon(2e-3));
    // What a large one gives less, ∝ 1/c_∞. Newton's method leaves 0.01 nm² of it.
    CHECK(without - with(30) == Approx(mixed(1e12) - mixed(30 * area)).epsilon(0.02));
}

TEST_CASE("fluid and membrane together keep their molecules while the membrane moves", "[bulk]") {
    Parameters p = small_case();
    p.molecules.exchange = Exchange::reservoir;
    p.molecules.on_rate = 500;
    p.molecules.off_rate = 200;
    p.molecules.curvature_sensing = 1;
    p.molecules.molecule_area = 0.1;
    add_bulk(p, 0.5, 2e4);
    p.molecules.bulk = GENERATE(Bulk::extracellular, Bulk::intracellular);
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    const double first = scheme.integrate().molecules;
    BulkMeasures seen;
    double largest = 0;
    run_steps(scheme, 5e-4, [&](double, double, const StepOutcome& outcome) {
        seen = outcome.diagnostics.bulk;
        largest = std::max(largest, seen.residual);
    });
    const double gained = scheme.integrate().molecules - first;
    INFO("gained " << gained << " of " << first << ", supply " << seen.supply << ", corrected " << seen.corrected);
    CHECK(gained > 0.1 * first);
    CHECK(seen.supply < 0.9);
    CHECK(largest < 1e-10);  // round-off of sums over 1e4 points
    CHECK(seen.corrected < 0.01 * gained);
}

TEST_CASE("a membrane that takes up all it meets is no stiff problem", "[bulk]") {
    // Within a step the layer would be emptied 1e4 times.
    Parameters p = exchanging_case();
    p.molecules.on_rate = 1e4;
    p.molecules.off_rate = 0;
    add_bulk(p, 1e-2, 2e4);
    ProductionScheme scheme(p, MPI_COMM_SELF);
    scheme.start();
    const double first = scheme.integrate().molecules;
    // What diffuses to a membrane that keeps c_b = 0, 2 c_∞ √(Dt/π); the coat, where 1 − c is 5e-4, takes it up as
    // well.
    const double area = std::numbers::pi * std::pow(p.domain.radius, 2);
    const double taken = area * 2 * p.molecules.molecule_area * p.molecules.bulk_concentration *
                         std::sqrt(p.molecules.bulk_diffusivity * 1e-3 / std::numbers::pi);
    double last = first, time = 0;
    constexpr double end = 1e-3;
    while (time < end * (1 - 1e-12)) {
        const double tau = scheme.step(time, end);
        const StepOutcome outcome = scheme.attempt(time, tau);
        if (!outcome.rejection.empty()) {  // what comes at first goes with the root of time
            scheme.reject(time, tau);
            continue;
        }
        scheme.keep(time, tau, outcome);
        scheme.follow(outcome.contour.curve);
        time += tau;
        CHECK(outcome.diagnostics.bulk.residual < 1e-10);
        CHECK(outcome.diagnostics.bulk.supply > -1e-3);
        CHECK(outcome.diagnostics.bulk.supply < 1);
        CHECK(scheme.integrate().molecules > last);
        last = scheme.integrate().molecules;
    }
    // √(Dt) is 1.9 ε, where the layer makes 9 % more of it on a membrane at rest; the steps and the edge add to that.
    CHECK(last - first == Approx(taken).epsilon(0.25));
}

TEST_CASE("a run with a bulk that is continued goes on as it would have", "[bulk]") {
    const TemporaryDirectory directory;
    Parameters p = exchanging_case();
    add_bulk(p, 0.3, 1e4);
    ProductionScheme scheme(p, MPI_COMM_SELF), continued(p, MPI_COMM_SELF);
    scheme.start();
    double time = 0;
    for (int k = 0; k < 3; ++k) take_step(scheme, time, 1);
    Checkpoint checkpoint;
    scheme.save(directory.path() / "checkpoint", checkpoint);
    continued.load(directory.path() / "checkpoint", checkpoint);
    const unsigned int before = scheme.factorisations();
    const auto one = scheme.attempt(time, 2e-5), other = continued.attempt(time, 2e-5);
    CHECK(scheme.factorisations() == before);  // else there would be nothing to compare
    // The continued run made new factors; Newton's method leaves 1e-6 of what flows to the coat.
    CHECK(other.diagnostics.bulk.molecules == Approx(one.diagnostics.bulk.molecules).epsilon(1e-8));
    CHECK(other.diagnostics.bulk.supply == Approx(one.diagnostics.bulk.supply).epsilon(1e-5));
    CHECK(other.diagnostics.exchange_rate == Approx(one.diagnostics.exchange_rate).epsilon(1e-5));
    CHECK(other.diagnostics.bulk.corrected ==
          Approx(one.diagnostics.bulk.corrected).margin(1e-8 * scheme.integrate().molecules));
}

TEST_CASE("a bulk on two processes is the same", "[mpi]") {
    Parameters p = exchanging_case();
    add_bulk(p, 0.3, 1e4);
    const auto supply = [&](MPI_Comm communicator) {
        ProductionScheme scheme(p, communicator);
        scheme.start();
        double time = 0;
        StepOutcome outcome;
        for (int k = 0; k < 3; ++k) outcome = take_step(scheme, time, 1);
        return outcome.diagnostics.bulk;
    };
    const BulkMeasures one = supply(MPI_COMM_SELF), two = supply(MPI_COMM_WORLD);
    // Newton's method ends at a hundredth of its first change, other factors elsewhere: 5e-7 of the coat.
    CHECK(two.molecules == Approx(one.molecules).epsilon(2e-6));
    CHECK(two.supply == Approx(one.supply).epsilon(2e-5));
    CHECK(two.residual < 1e-10);
}
