// Thermal noise: equipartition of what has equilibrium, reciprocity of what moves it, covariances in time.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "boundary_integral/modes/covariance_propagation.h"
#include "boundary_integral/modes/linearised_membrane.h"
#include "boundary_integral/modes/noisy_quantities.h"
#include "boundary_integral/modes/perturbations.h"
#include "boundary_integral/modes/thermal_noise.h"
#include "curves.h"
#include "modes_states.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;
using std::numbers::pi;

constexpr double thermal_energy = boltzmann_constant * 310;  // pN nm

// int psi_j f r g dxi of the displacement's functions, and int f^2 r g dxi: amplitudes of f cos(m phi).
struct Projection {
    Eigen::VectorXd row;
    double square;
};
Projection projection(const ModeSpace& space, const BasePoints& base, const Profile& f) {
    const MembraneSpace& membrane = space.membrane();
    Eigen::VectorXd values(membrane.points());
    double square = 0;
    for (Index i = 0; i < membrane.points(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double area = membrane.weight[at] * base.points[at].curve.r * base.points[at].curve.g;
        const double value = f(membrane.xi[at]);
        values[i] = area * value;
        square += area * value * value;
    }
    return {displacement_values(space, membrane.xi).transpose() * values, square};
}

// Of the amplitude a of w = a f/|f|, |f|^2 = int f^2 cos^2(m phi) dA, from the covariance of w.
double variance(const ModeSpace& space, const BasePoints& base, const Profile& f, const Eigen::MatrixXd& covariance) {
    const Projection onto = projection(space, base, f);
    return azimuthal_weight(space.mode()) * onto.row.dot(covariance * onto.row) / onto.square;
}

// Clamped circular plate of radius R under tension: J_m(k r)/J_m(k R) - I_m(q r)/I_m(q R), q^2 = k^2 + sigma/beta,
// whose slope vanishes at the rim; lambda = beta k^4 + sigma k^2.
struct ClampedPlate {
    int mode;
    double radius, ratio;  // ratio: sigma/beta

    [[nodiscard]] double second(double k) const { return std::sqrt(k * k + ratio); }
    [[nodiscard]] double slope(double k) const {
        const double x = k * radius, y = second(k) * radius;
        const double j1 = std::cyl_bessel_j(mode + 1, x), j = std::cyl_bessel_j(mode, x);
        // x J_m' = m J_m - x J_{m+1}, y I_m' = m I_m + y I_{m+1}
        return x * j1 + y * std::cyl_bessel_i(mode + 1, y) / std::cyl_bessel_i(mode, y) * j;
    }
    [[nodiscard]] double shape(double k, double r) const {
        const double y = second(k);
        return std::cyl_bessel_j(mode, k * r) / std::cyl_bessel_j(mode, k * radius) -
               std::cyl_bessel_i(mode, y * r) / std::cyl_bessel_i(mode, y * radius);
    }
    [[nodiscard]] std::vector<double> wave_numbers(std::size_t count) const {
        std::vector<double> found;
        const double step = 0.05 / radius;
        for (double k = 20 * step; found.size() < count; k += step) {
            double low = k, high = k + step;
            if (slope(low) * slope(high) > 0) continue;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (slope(low) * slope(middle) > 0 ? low : high) = middle;
            }
            found.push_back(0.5 * (low + high));
        }
        return found;
    }
};

BasePoints flat_points(const Parameters& parameters, const MembraneSpace& space) {
    MembraneState state;
    state.r = spline_of(space.radial(), [&](double x) { return parameters.domain.radius * x; });
    return base_points(space, flat_bare_membrane(space, state, parameters), membrane_energy(parameters),
                       {parameters.fluid.viscosity_extracellular, parameters.fluid.viscosity_intracellular});
}

// M on displacements in the inner product of w: |w|^2 = int w^2 dA/pi.
Eigen::MatrixXd mobility_of(const LinearisedMembrane& membrane, const ModeSpace& space, const ModeRates& rates) {
    const Index w = rates.displacements;
    const Eigen::MatrixXd root = perturbation_norms(space, membrane.points()).displacement;
    return root * rates.thermal_mobility.topLeftCorner(w, w) * root.transpose();
}

double asymmetry(const Eigen::MatrixXd& matrix) {
    return (matrix - matrix.transpose()).norm() / matrix.norm();
}

// |A + M H|/|A| of the displacements.
double unaccounted(const LinearisedMembrane& membrane, const ModeSpace& space) {
    const ModeRates rates = membrane.rates(space.mode());
    const Index w = rates.displacements;
    const Eigen::MatrixXd a = rates.material.topLeftCorner(w, w);
    return (a + rates.thermal_mobility.topLeftCorner(w, w) * second_variation(space, membrane.points())).norm() /
           a.norm();
}

// What does not change: rates and noise of w alone.
NoisyRate frozen(const LinearisedMembrane& membrane, const ModeSpace& space) {
    const ModeRates rates = membrane.rates(space.mode());
    const Index w = rates.displacements;
    return {{rates.material.topLeftCorner(w, w), perturbation_norms(space, membrane.points()).displacement},
            noise_strength(space.mode(), rates, thermal_energy).topLeftCorner(w, w)};
}

Covariance without_noise(const NoisyRate& rate) {
    return {Eigen::MatrixXd::Zero(rate.noise.rows(), 1), Eigen::MatrixXd::Zero(rate.noise.rows(), rate.noise.cols())};
}

double distance(const Eigen::MatrixXd& root, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (root * (a - b) * root.transpose()).norm() / (root * b * root.transpose()).norm();
}

}  // namespace

TEST_CASE("equipartition in the pinned disc: every mode of the flat membrane has k_B T/lambda", "[modes]") {
    Parameters parameters;
    parameters.membrane.rim_tension = GENERATE(0.0, 0.05);  // the latter is more than bending in the lowest modes
    const double beta = BendingModel(parameters.membrane).stiffness(0).value;
    const double sigma = parameters.membrane.rim_tension, radius = parameters.domain.radius;
    const MembraneSpace membrane(96, 8);
    const ParitySpaces parities(membrane);
    const BasePoints points = flat_points(parameters, membrane);
    for (int mode = 0; mode <= 4; ++mode) {
        const ModeSpace space(membrane, parities, mode);
        const Eigen::MatrixXd root = equilibrium_root(space, points, thermal_energy);
        const Eigen::MatrixXd covariance = root * root.transpose();
        const ClampedPlate plate{mode, radius, sigma / beta};
        for (const double k : plate.wave_numbers(20)) {
            const double expected = thermal_energy / (beta * std::pow(k, 4) + sigma * k * k);
            const double found = variance(
                space, points, [&](double x) { return plate.shape(k, radius * x); }, covariance);
            CAPTURE(sigma, mode, k, found / expected - 1);
            // Quintic splines, k h < 0.75: eigenvalues are exact to (k h)^8 times a small number.
            CHECK(found == Approx(expected).epsilon(1e-6));
        }
    }
}

TEST_CASE("a flat membrane that tension buckles has no equilibrium", "[modes]") {
    Parameters parameters;
    parameters.membrane.rim_tension = -1;  // of a clamped plate: -14.7 beta/R^2 is enough
    const MembraneSpace membrane(16, 8);
    const ParitySpaces parities(membrane);
    const ModeSpace space(membrane, parities, 0);
    CHECK_THROWS_AS(equilibrium_root(space, flat_points(parameters, membrane), thermal_energy), SolverError);
}

TEST_CASE("second variations are symmetric, mobilities symmetric and positive", "[modes]") {
    const Parameters parameters;
    const auto asymmetries = [&](Index elements) {
        const MembraneSpace space(elements, 8);
        const Surroundings surroundings(parameters, space, 4);
        const LinearisedMembrane membrane(parameters, surroundings, at_rest(space, bulge(space, 30)));
        std::vector<double> result;
        for (int mode = 0; mode <= 4; ++mode) {
            const ModeSpace& of_mode = surroundings.space(mode);
            CHECK(asymmetry(second_variation(of_mode, membrane.points())) < 1e-13);
            const Eigen::MatrixXd mobility = mobility_of(membrane, of_mode, membrane.rates(mode));
            const Eigen::VectorXd values =
                Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (mobility + mobility.transpose())).eigenvalues();
            // 1/(4 nu k) of the mesh's own wave numbers, far from 0.
            CHECK(values[0] > 1e-3 * values[values.size() - 1]);
            result.push_back(asymmetry(mobility));
        }
        return result;
    };
    const std::vector<double> coarse = asymmetries(24), fine = asymmetries(48);
    for (std::size_t mode = 0; mode < fine.size(); ++mode) {
        CAPTURE(mode, coarse[mode], fine[mode]);
        // A collocation's, of every load that the mesh knows, the roughest too; smooth ones have 5e-4, see
        // modes_box_test.
        CHECK(fine[mode] < 0.02);
        CHECK(coarse[mode] / fine[mode] > 2);
    }
}

TEST_CASE("at rest the rates are those of mobility and second variation, A = - M H", "[modes]") {
    Parameters parameters;
    parameters.membrane.rim_tension = 0.05;
    const MembraneSpace space(32, 8);
    const Surroundings surroundings(parameters, space, 4);
    const MembraneState state = {spline_of(space.radial(), [](double x) { return 80 * x; }), {}, {}};
    const LinearisedMembrane flat(parameters, surroundings, flat_bare_membrane(space, state, parameters));
    // Displacements of the flat membrane are velocities of the same space: equal to round-off.
    for (int mode = 0; mode <= 4; ++mode) CHECK(unaccounted(flat, surroundings.space(mode)) < 1e-12);

    // Elsewhere w n is none of the velocities' splines: of second order, for rates of the mesh's own ripples.
    const Parameters vesicle = vesicle_parameters(1e-3, 1e-2);
    const auto of_sphere = [&](Index elements) {
        const MembraneSpace closed(elements, 8, CurveEnd::closed);
        const Surroundings around(vesicle, closed, 4);
        const LinearisedMembrane sphere(vesicle, around, sphere_at_rest(closed, BendingModel(vesicle.membrane), 7));
        std::vector<double> result;
        for (int mode = 0; mode <= 4; ++mode) result.push_back(unaccounted(sphere, around.space(mode)));
        return result;
    };
    const std::vector<double> coarse = of_sphere(24), fine = of_sphere(48);
    for (std::size_t mode = 0; mode < fine.size(); ++mode) {
        CAPTURE(mode, coarse[mode], fine[mode]);
        CHECK(fine[mode] < 2e-3);
        CHECK(coarse[mode] / fine[mode] > 3);
    }
}

TEST_CASE("the equilibrium of the flat membrane stays, and is what noise makes of a membrane without any", "[modes]") {
    Parameters parameters;
    parameters.membrane.rim_tension = 0.05;
    const MembraneSpace space(40, 8);
    const Surroundings surroundings(parameters, space, 4);
    const MembraneState state = {spline_of(space.radial(), [](double x) { return 80 * x; }), {}, {}};
    const LinearisedMembrane flat(parameters, surroundings, flat_bare_membrane(space, state, parameters));
    std::vector<NoisyRate> rates;
    std::vector<Eigen::MatrixXd> equilibria;
    std::vector<Covariance> at_rest, inherited, none;
    for (int mode = 0; mode <= 4; ++mode) {
        rates.push_back(frozen(flat, surroundings.space(mode)));
        const Eigen::MatrixXd root = equilibrium_root(surroundings.space(mode), flat.points(), thermal_energy);
        equilibria.emplace_back(root * root.transpose());
        none.push_back(without_noise(rates.back()));
        at_rest.push_back({none.back().inherited_root, equilibria.back()});
        inherited.push_back({root, none.back().gathered});
    }
    const auto error_of = [&](const std::vector<Covariance>& start, double end, std::size_t k) {
        CovariancePropagation propagation([&](double) { return std::vector<NoisyRate>{rates[k]}; }, 0.0, {start[k]},
                                          1e-7, 1e-3);
        propagation.advance(end);
        return distance(rates[k].linear.root, propagation.values()[0].total(), equilibria[k]);
    };
    for (std::size_t k = 0; k < rates.size(); ++k) {
        CAPTURE(k);
        // Round-off: 1e-16 of the fastest rate (1e5/µs) over the slowest.
        CHECK(error_of(at_rest, 1.0, k) < 1e-8);
        // The slowest rate is 0.3/µs; long steps damp it less than it decays.
        CHECK(error_of(none, 1000.0, k) < 1e-8);
        // What the noise gathers makes up for what decays, to the tolerance of some ten steps.
        CHECK(error_of(inherited, 1.0, k) < 1e-2);
    }
}

TEST_CASE("a nearly spherical vesicle fluctuates as Milner and Safran have it, and diffuses as Stokes", "[modes]") {
    const double sigma = GENERATE(0.0, 7.0), outer = 1e-2;
    const Parameters parameters = vesicle_parameters(1e-3, outer);
    const MembraneSpace space(32, 8, CurveEnd::closed);
    const double stiffness = BendingModel(parameters.membrane).stiffness(0).value;
    const Surroundings surroundings(parameters, space, 3);
    const LinearisedMembrane sphere(parameters, surroundings,
                                    sphere_at_rest(space, BendingModel(parameters.membrane), sigma));
    std::vector<NoisyRate> rates;
    std::vector<Covariance> none;
    for (int mode = 0; mode <= 3; ++mode) {
        rates.push_back(frozen(sphere, surroundings.space(mode)));
        none.push_back(without_noise(rates.back()));
    }
    constexpr double end = 100;  // µs; the slowest rate is 1/µs
    CovariancePropagation propagation([&](double) { return rates; }, 0.0, none, 1e-7, 1e-3);
    propagation.advance(end);
    for (int mode = 0; mode <= 3; ++mode) {
        const auto of = [&](int l) {
            const auto harmonic = [&](double x) {
                return std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(mode), std::cos(pi * x));
            };
            return variance(surroundings.space(mode), sphere.points(), harmonic,
                            propagation.values()[static_cast<std::size_t>(mode)].total());
        };
        // Phys. Rev. A 36, 4371 (1987): r = R (1 + sum u_lm Y_lm), <u_lm^2> = k_B T/(kappa (l-1)(l+2)(l(l+1)+sigma)).
        // a of w = a f/|f| with |f|^2 = R^2 int Y^2 is R^2 u.
        for (int l = std::max(mode, 2); l <= 8; ++l) {
            const double expected = thermal_energy / (stiffness * (l - 1) * (l + 2) * (l * (l + 1) + sigma));
            const double found = of(l) / std::pow(sphere_radius, 4);
            CAPTURE(sigma, mode, l, found / expected - 1);
            CHECK(found == Approx(expected).epsilon(1e-4));
        }
        if (mode != 1) continue;
        // An inextensible sphere moves as a rigid one: <x^2> = 2 k_B T t/(6 pi nu R), w = x sin(theta).
        const double displacement = of(1) / (4 * pi * sphere_radius * sphere_radius / 3);
        CHECK(displacement == Approx(2 * thermal_energy * end / (6 * pi * outer * sphere_radius)).epsilon(1e-4));
    }
}

TEST_CASE("a bud that is moved, or flattened, is so by as much", "[modes]") {
    // A sphere above the plane where three quarters of its meridian end.
    const Parameters parameters = vesicle_parameters(1e-3, 1e-2);
    const MembraneSpace space(32, 8, CurveEnd::closed);
    const Surroundings surroundings(parameters, space, 2);
    BaseState base = sphere_at_rest(space, BendingModel(parameters.membrane), 0);
    base.traction_sum = Eigen::VectorXd::Zero(space.force_count());
    const double end = 0.76, radius = sphere_radius * std::sin(pi * end);
    const BudQuantities bud = bud_quantities(surroundings, base, {radius, 2 * sphere_radius, end});
    const auto change = [&](const NoisyQuantity& quantity, const Profile& w) {
        const ModeSpace& mode = surroundings.space(quantity.mode);
        const Eigen::MatrixXd expansion = mode.displacement_expansion();
        const Eigen::VectorXd free =
            (expansion.transpose() * expansion).ldlt().solve(expansion.transpose() * spline_of(mode.vertical(), w));
        return quantity.row.dot(free);
    };
    // n_r = sin(theta); x (1 + e), y (1 - e) is w = e r n_r cos 2 phi. Splines of 32 elements: 1e-7.
    CHECK(change(bud.sideways, [](double x) { return std::sin(pi * x); }) == Approx(1).epsilon(1e-6));
    CHECK(change(bud.ellipticity, [](double x) { return 0.1 * sphere_radius * std::pow(std::sin(pi * x), 2); }) ==
          Approx(0.1).epsilon(1e-6));
    // Where the meridian is vertical: the equator as a neck.
    const BudQuantities ring = bud_quantities(surroundings, base, {sphere_radius, 2 * sphere_radius, 0.5});
    CHECK(change(ring.neck, [](double) { return 0.3; }) == Approx(0.3).epsilon(1e-9));
    CHECK(change(ring.neck_ellipticity, [](double x) { return 0.3 * std::pow(std::sin(pi * x), 2); }) ==
          Approx(0.3 / sphere_radius).epsilon(1e-6));
    CHECK(change(pole_height(surroundings, base), [](double) { return 0.3; }) == Approx(0.3).epsilon(1e-9));
}

namespace {

// Sigma = R(t) diag(..) R(t)^T with a rotation by the angle sin 2t.
struct NoisyRotation {
    double a, b, noise;
    static Eigen::Matrix2d rotation(double t) { return Eigen::Rotation2Dd(std::sin(2 * t)).toRotationMatrix(); }
    [[nodiscard]] std::vector<NoisyRate> operator()(double t) const {
        Eigen::Matrix2d spin;
        spin << 0, -1, 1, 0;
        const Eigen::Matrix2d r = rotation(t);
        const Eigen::Matrix2d rate =
            r * Eigen::Vector2d(a, b).asDiagonal() * r.transpose() + 2 * std::cos(2 * t) * spin;
        return {{{rate, Eigen::Matrix2d::Identity()}, r * Eigen::Vector2d(noise, noise).asDiagonal() * r.transpose()}};
    }
    [[nodiscard]] Eigen::Matrix2d inherited(double t) const {
        return rotation(t) * Eigen::Vector2d(std::exp(2 * a * t), std::exp(2 * b * t)).asDiagonal() *
               rotation(t).transpose();
    }
    [[nodiscard]] Eigen::Matrix2d gathered(double t) const {
        const auto grown = [&](double rate) { return noise * std::expm1(2 * rate * t) / (2 * rate); };
        return rotation(t) * Eigen::Vector2d(grown(a), grown(b)).asDiagonal() * rotation(t).transpose();
    }
};

struct NoisyResult {
    double inherited, total;
    long steps;
};
NoisyResult follow(const NoisyRotation& system, double tolerance) {
    const Covariance start = {Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero()};
    CovariancePropagation propagation(system, 0.0, {start}, 1e-3, tolerance);
    propagation.advance(0.7);
    propagation.advance(2.0);
    const Covariance& reached = propagation.values()[0];
    const Eigen::Matrix2d inherited = reached.inherited_root * reached.inherited_root.transpose();
    const Eigen::Matrix2d total = system.inherited(2) + system.gathered(2);
    return {(inherited - system.inherited(2)).norm() / system.inherited(2).norm(),
            (reached.total() - total).norm() / total.norm(), propagation.steps()};
}

}  // namespace

TEST_CASE("covariances of a system that turns are followed with order 3", "[modes]") {
    const NoisyRotation system{0.4, -1.5, 0.8};
    const NoisyResult coarse = follow(system, 1e-3), fine = follow(system, 1e-6);
    CAPTURE(coarse.inherited, coarse.total, coarse.steps, fine.inherited, fine.total, fine.steps);
    // Errors of the steps add up. The estimate falls as h^3: ten times as many steps, an error of 1e-3 then.
    CHECK(fine.inherited < 1e-5);
    CHECK(fine.total < 1e-5);
    CHECK(fine.inherited < 5e-3 * coarse.inherited);
    CHECK(fine.total < 5e-3 * coarse.total);
    CHECK(fine.steps < 15 * coarse.steps);
    // What decays within a step is in its equilibrium with the noise, and does not make steps small.
    const NoisyRotation stiff{0.4, -1e7, 0.8};
    const NoisyResult result = follow(stiff, 1e-3);
    CAPTURE(result.inherited, result.total, result.steps);
    CHECK(result.inherited < 1e-2);
    CHECK(result.total < 1e-2);
    CHECK(result.steps < 4 * coarse.steps);
}
